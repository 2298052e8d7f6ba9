// One scene: its pictures, the values of its pixels, and what is known of them.
import {bar, legend, parts} from "./budget.js";
import {command} from "./clipboard.js";
import {element} from "./dom.js";
import {explanation} from "./explanation.js";
import {readout} from "./pixel.js";
import {remember} from "./router.js";
import {Stage} from "./stage.js";
import {badge} from "./status.js";
import {picture_of} from "./store.js";
import {bounds, figures, metrics, terms} from "./tables.js";
import {make_toolbar, modes, most_stops} from "./toolbar.js";

const half_stop = 0.5;

function panel(title, ...children) {
  return element("section", {class: "panel", "aria-label": title}, element("h2", {}, title), ...children);
}

const sentence = (text) => `${text[0].toUpperCase()}${text.slice(1)}.`;

const no_pictures = ({not_compared: why}) => `There are no pictures of this scene${why ? `: ${why}` : ""}.`;

function budget_of({budget, not_compared: why}) {
  if (why) return [element("p", {class: "hint"}, sentence(why))];
  if (parts(budget).length === 0) return [element("p", {class: "hint"}, "No pixel is over the tolerance.")];
  return [bar(budget), legend(budget)];
}

export class SceneView {
  /** `lead.previous(scene)` and `lead.next(scene)`: scenes or nothing; `lead.go(scene)`; `lead.is_alone`: there is no other. */
  constructor(view, lead) {
    this.view = view;
    this.lead = lead;
    this.readout = element("div", {class: "readout"});
    this.explanation = element("div", {class: "explanation", "aria-live": "polite"});
    this.actions = this.make_actions();
    this.toolbar = make_toolbar(view, this.actions);
    this.stage = new Stage(view, this.toolbar.range, {
      on_point: (pixel) => this.update_readout(pixel),
      on_pick: (pixel) => this.pick(pixel, false),
      on_zoom: (k) => this.toolbar.set_zoom(k),
    });
    this.head = element("div", {class: "scene-head"});
    this.side = element("div", {class: "side"});
    this.left = element("div", {class: "left"});
    this.node = element("main", {id: "main", class: "scene", tabindex: "-1"}, this.head,
      element("div", {class: "columns"}, this.left, this.side));
  }

  async show(scene, where) {
    this.scene = scene;
    this.picture = null;
    this.stage.stop();
    if (modes.some(([mode]) => mode === where.view)) this.view.mode = where.view;
    this.update_head();
    this.side.replaceChildren(...this.panels());
    this.toolbar.set_encoded(scene.encoded ?? {});
    this.toolbar.update();
    if (!scene.picture) return this.say(no_pictures(scene.result));
    if (!this.left.contains(this.stage.node)) this.say("Reading the pictures …");
    try {
      const picture = await picture_of(scene);
      if (this.scene === scene) this.show_picture(picture, where.pixel);
    } catch (error) {
      if (this.scene === scene) this.say(`The pictures cannot be shown: ${error.message}`);
    }
    return undefined;
  }

  say(text) { this.left.replaceChildren(element("p", {class: "notice", role: "status"}, text)); }

  show_picture(picture, pixel) {
    this.picture = picture;
    if (!this.left.contains(this.stage.node)) this.left.replaceChildren(this.toolbar.node, this.stage.node);
    this.stage.show(picture, this.scene);
    const is_inside = pixel && pixel.x < picture.width && pixel.y < picture.height;
    this.pick(is_inside ? pixel : this.worst(), false);
    this.node.dataset.ready = this.scene.key;
  }

  worst() {
    const {worst, pixels_over: over} = this.scene.result;
    const is_inside = worst && worst.x < this.picture.width && worst.y < this.picture.height && worst.x >= 0 && worst.y >= 0;
    return over > 0 && is_inside ? {x: worst.x, y: worst.y} : null;
  }

  update_head() {
    const {scene, lead} = this;
    const step = (label, title, to) => element("button", {type: "button", title, "aria-label": title, disabled: !to,
      onclick: () => lead.go(to)}, label);
    this.head.replaceChildren(
      element("p", {class: "conclusion"}, scene.conclusion),
      ...(lead.is_alone ? [] : [element("a", {href: "#", class: "back"}, "← Overview")]),
      element("h1", {}, scene.name), badge(scene.result.status),
      ...(lead.is_alone ? [] : [element("span", {class: "steps"},
        step("‹", "Previous scene (k)", lead.previous(scene)), step("›", "Next scene (j)", lead.next(scene)))]));
  }

  panels() {
    const {scene} = this;
    const {result} = scene;
    return [
      result.message ? panel("Message", element("pre", {tabindex: "0"}, result.message)) : null,
      scene.picture ? panel("Pixel", this.readout) : null,
      scene.picture ? panel("Explanation", this.explanation) : null,
      result.budget || result.not_compared ? panel("Pixel budget", ...budget_of(result)) : null,
      result.terms ? panel("Term by term", terms(result)) : null,
      panel("Figures", figures(scene)),
      result.bounds ? panel("Bounds", bounds(result)) : null,
      result.metrics ? panel("Metrics", metrics(result)) : null,
      scene.approve ? panel("Approve", element("p", {class: "hint"}, "If the new picture is right, this makes it the baseline:"),
        command(scene.approve, "approve this picture")) : null,
    ].filter(Boolean);
  }

  pick(pixel, is_sought) {
    this.picked = pixel;
    this.stage.pick(pixel, is_sought);
    this.update_readout(null);
    this.explanation.replaceChildren(...explanation(this.scene, this.picture, pixel));
    remember({scene: this.scene.key, view: this.view.mode, pixel});
  }

  update_readout(pointed) {
    if (!this.picture) return;
    const origin = pointed ? "under the pointer" : "picked";
    this.readout.replaceChildren(...readout(this.picture, this.scene.causes, pointed ?? this.picked, origin));
  }

  move_pixel(e) {
    const step = e.shiftKey ? 10 : 1;
    const [dx, dy] = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]}[e.key];
    const from = this.picked ?? {x: 0, y: 0};
    const within = (value, size) => Math.max(0, Math.min(size - 1, value));
    this.pick({x: within(from.x + dx, this.picture.width), y: within(from.y + dy, this.picture.height)}, false);
  }

  set_mode(mode) {
    this.view.mode = mode;
    this.stage.arrange();
    this.toolbar.update();
    remember({scene: this.scene.key, view: mode, pixel: this.picked});
  }

  set_exposure(stops) {
    this.view.exposure = Math.max(-most_stops, Math.min(most_stops, stops));
    this.reshade();
  }

  flip(key) {
    this.view[key] = !this.view[key];
    this.reshade();
  }

  reshade() {
    this.toolbar.update();
    this.stage.reshade();
  }

  /** What the toolbar and the keys do; nothing before there is a picture. */
  make_actions() {
    const when_shown = (act) => (e) => { if (this.picture) act(e); };
    const go = (scene) => { if (scene) this.lead.go(scene); };
    const view = {
      set_mode: (mode) => this.set_mode(mode),
      mode_number: (e) => this.set_mode(modes[Number(e.key) - 1][0]),
      swap: () => { if (this.view.mode === "blink") { this.view.is_paused = true; this.toolbar.update(); this.stage.update_blinking(); this.stage.swap(); } },
      toggle_pause: () => { this.view.is_paused = !this.view.is_paused; this.toolbar.update(); this.stage.update_blinking(); },
      zoom_in: () => this.stage.scale_by(1.5),
      zoom_out: () => this.stage.scale_by(1 / 1.5),
      fit: () => this.stage.fit(),
      one_to_one: () => this.stage.scale_to(1),
      set_exposure: (stops) => this.set_exposure(stops),
      brighter: () => this.set_exposure(this.view.exposure + half_stop),
      darker: () => this.set_exposure(this.view.exposure - half_stop),
      reset_exposure: () => this.set_exposure(0),
      toggle_curve: () => { if (!this.toolbar.has_curve()) return; this.flip("is_srgb"); },
      toggle_marks: () => this.flip("has_marks"),
      toggle_range: () => this.flip("is_own_range"),
      worst: () => this.pick(this.worst(), true),
      move_pixel: (e) => this.move_pixel(e),
    };
    const guarded = Object.fromEntries(Object.entries(view).map(([name, act]) => [name, when_shown(act)]));
    return {...guarded, next: () => go(this.lead.next(this.scene)), previous: () => go(this.lead.previous(this.scene)),
      overview: () => { location.hash = ""; }};
  }
}
