// The page: overview or one scene, chosen by the address.
import {know_causes} from "./budget.js";
import {make_about, make_help} from "./dialogs.js";
import {element} from "./dom.js";
import {thumbnail_filter} from "./heat.js";
import {listen} from "./keys.js";
import {Overview} from "./overview.js";
import {address, place} from "./router.js";
import {SceneView} from "./scene.js";
import {read_report} from "./store.js";

const report = read_report();
know_causes(report.causes);
const settings = {has_shortcuts: true};
const view = {mode: "slider", exposure: 0, is_srgb: true, has_marks: false, is_own_range: false,
  is_paused: matchMedia("(prefers-reduced-motion: reduce)").matches};
const overview = new Overview(report);
const scenes = new Map(report.scenes.map((scene) => [scene.key, scene]));

function neighbour(scene, step) {
  const shown = overview.shown();
  const at = shown.indexOf(scene);
  return at < 0 ? shown[0] : shown[at + step];
}

const scene_view = new SceneView(view, {
  previous: (scene) => neighbour(scene, -1),
  next: (scene) => neighbour(scene, 1),
  is_alone: report.scenes.length === 1,
  go: (scene) => { location.hash = address({scene: scene.key, view: view.mode}); },
});

const help = make_help(settings);
const about = make_about(report);
const content = element("div", {class: "content"});
let place_in_overview = 0;

function show() {
  const where = place();
  // Of one scene there is nothing to overlook.
  const scene = scenes.get(where.scene) ?? (report.scenes.length === 1 ? report.scenes[0] : undefined);
  if (content.firstChild === overview.node) place_in_overview = scrollY;
  if (!scene) scene_view.stage.stop();
  const node = scene ? scene_view.node : overview.node;
  if (content.firstChild !== node) content.replaceChildren(node);
  document.title = scene ? `${scene.name} – ${report.title}` : report.title;
  document.body.dataset.shows = scene ? "scene" : "overview";
  scrollTo(0, scene ? 0 : place_in_overview);
  if (scene) scene_view.show(scene, where);
}

const overview_actions = {
  filter: () => overview.search.focus(),
  next: () => { const [first] = overview.shown(); if (first) location.hash = address({scene: first.key}); },
};
const common_actions = {help: () => help.showModal()};
listen(() => ({...(document.body.dataset.shows === "scene" ? scene_view.actions : overview_actions), ...common_actions}), settings);

const bar_button = (label, title, dialog) => element("button", {type: "button", class: "small", title, onclick: () => dialog.showModal()}, label);
document.getElementById("app").replaceChildren(
  element("header", {class: "top"}, element("div", {class: "titles"}, element("p", {class: "title"}, report.title),
    report.subtitle ? element("p", {class: "muted subtitle"}, report.subtitle) : null),
  bar_button("Keys ?", "Keyboard shortcuts (?)", help), bar_button("About", "About this page, and licences", about)),
  content, help, about, thumbnail_filter());
addEventListener("hashchange", show);
show();
