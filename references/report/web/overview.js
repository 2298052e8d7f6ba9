// All scenes in one table: filtered, sorted, worst first.
import {bar, parts} from "./budget.js";
import {element} from "./dom.js";
import {count, figure, seconds, words} from "./format.js";
import {address} from "./router.js";
import {badge, describe} from "./status.js";

const total_seconds = ({seconds: s}) => (s && typeof s === "object" ? Object.values(s).reduce((a, b) => a + b, 0) : s);
const number = (key) => (scene) => scene.result[key];

/** id, title, value to sort by, and whether the largest comes first. */
const columns = [
  ["name", "Name", (scene) => scene.name],
  ["status", "Result", (scene) => describe(scene.result.status).rank],
  ["max_error", "Max error", number("max_error"), true],
  ["mean_error", "Mean", number("mean_error"), true],
  ["rms_error", "RMS", number("rms_error"), true],
  ["pixels_over", "Over", number("pixels_over"), true],
  ["unexplained", "Unexplained", (scene) => scene.result.budget?.unexplained, true],
  ["seconds", "CPU", (scene) => total_seconds(scene.result), true],
];

function compared(a, b) {
  if (a === undefined || a === null) return b === undefined || b === null ? 0 : 1;
  if (b === undefined || b === null) return -1;
  return typeof a === "string" ? a.localeCompare(b, "en", {numeric: true}) : a - b;
}

function thumbnail(scene, key, what) {
  if (!scene[key]) return element("span", {class: "thumbnail none", "aria-hidden": "true"});
  return element("img", {class: `thumbnail ${key}`, src: scene[key], alt: `${what}: ${scene.name}`, loading: "lazy", decoding: "async"});
}

function row(scene) {
  const {result} = scene;
  const link = element("a", {href: address({scene: scene.key})}, scene.name);
  const cell = (title, text) => element("td", {class: text === "–" ? "number empty" : "number", "data-title": title}, text);
  const node = element("tr", {},
    element("td", {class: "pictures"}, thumbnail(scene, "thumbnail", "Yours"), thumbnail(scene, "error_thumbnail", "Difference")),
    element("th", {scope: "row"}, link, result.message ? element("span", {class: "message"}, result.message.split("\n")[0]) : null),
    element("td", {"data-title": "Result"}, badge(result.status)),
    cell("Max error", figure(result.max_error)), cell("Mean", figure(result.mean_error)), cell("RMS", figure(result.rms_error)),
    element("td", {class: result.pixels_over === undefined ? "number empty" : "number over", "data-title": "Over"}, count(result.pixels_over), parts(result.budget).length > 0 ? bar(result.budget) : null,
      result.non_finite > 0 ? element("span", {class: "warning"}, `${count(result.non_finite)} not finite`) : null),
    cell("Unexplained", count(result.budget?.unexplained)), cell("CPU", seconds(result.seconds)));
  node.addEventListener("click", (e) => { if (!e.target.closest("a") && getSelection().isCollapsed) link.click(); });
  return node;
}

export class Overview {
  constructor(report) {
    this.scenes = report.scenes;
    this.sort = {id: "status", is_descending: false};
    this.text = "";
    this.hidden = new Set();
    this.rows = new Map();
    this.body = element("tbody");
    this.outcome = element("p", {class: "outcome muted", role: "status"});
    this.node = element("main", {id: "main", class: "overview", tabindex: "-1"},
      element("p", {class: "conclusion"}, report.conclusion), this.controls(), this.table());
    this.update();
  }

  controls() {
    this.search = element("input", {type: "search", id: "filter", placeholder: "Filter by name, message or cause ( / )",
      "aria-label": "Filter results", autocomplete: "off", spellcheck: "false",
      oninput: () => { this.text = this.search.value.toLowerCase(); this.update(); }});
    this.select = element("select", {"aria-label": "Sort by", class: "sort-by", onchange: () => this.sort_by(this.select.value)},
      columns.map(([id, title]) => element("option", {value: id}, `Sort: ${title}`)));
    return element("div", {class: "controls"}, this.search,
      element("div", {class: "group", role: "group", "aria-label": "Results shown"}, this.status_buttons()), this.select, this.outcome);
  }

  status_buttons() {
    const found = [...new Set(this.scenes.map((scene) => scene.result.status))].sort((a, b) => describe(a).rank - describe(b).rank);
    return found.map((status) => {
      const number_of = this.scenes.filter((scene) => scene.result.status === status).length;
      const button = element("button", {type: "button", class: "status-filter", "aria-pressed": "true", "data-status": status,
        title: "Show or hide", onclick: () => {
          if (!this.hidden.delete(status)) this.hidden.add(status);
          button.setAttribute("aria-pressed", String(!this.hidden.has(status)));
          this.update();
        }}, badge(status), element("span", {class: "number"}, count(number_of)));
      return button;
    });
  }

  table() {
    this.heads = columns.map(([id, title]) => element("th", {scope: "col", "data-column": id},
      element("button", {type: "button", onclick: () => this.sort_by(id)}, title, element("span", {class: "arrow", "aria-hidden": "true"}))));
    return element("table", {class: "scenes"}, element("thead", {}, element("tr", {},
      element("th", {scope: "col"}, element("span", {class: "plain"}, "Yours | difference")), this.heads)), this.body);
  }

  sort_by(id) {
    const is_largest_first = Boolean(columns.find((column) => column[0] === id)[3]);
    this.sort = {id, is_descending: this.sort.id === id ? !this.sort.is_descending : is_largest_first};
    this.update();
  }

  is_shown(scene) {
    if (this.hidden.has(scene.result.status)) return false;
    const causes = parts(scene.result.budget).map(([cause]) => words(cause)).join(" ");
    return `${scene.name} ${scene.result.message ?? ""} ${causes}`.toLowerCase().includes(this.text);
  }

  /** The scenes shown, in their order; that is also where next and previous lead. */
  shown() {
    const value = columns.find(([id]) => id === this.sort.id)[2];
    const is_missing = (scene) => value(scene) === undefined || value(scene) === null;
    const sign = this.sort.is_descending ? -1 : 1;
    return this.scenes.filter((scene) => this.is_shown(scene)).sort((a, b) =>
      (is_missing(a) || is_missing(b) ? compared(value(a), value(b)) : sign * compared(value(a), value(b))) || a.index - b.index);
  }

  row_of(scene) {
    if (!this.rows.has(scene)) this.rows.set(scene, row(scene));
    return this.rows.get(scene);
  }

  update() {
    const shown = this.shown();
    this.body.replaceChildren(...shown.map((scene) => this.row_of(scene)));
    this.outcome.textContent = shown.length === this.scenes.length ? `${count(shown.length)} results`
      : `${count(shown.length)} of ${count(this.scenes.length)} results`;
    this.select.value = this.sort.id;
    for (const head of this.heads) {
      const is_sorted = head.dataset.column === this.sort.id;
      const order = this.sort.is_descending ? "descending" : "ascending";
      head.setAttribute("aria-sort", is_sorted ? order : "none");
      head.querySelector(".arrow").textContent = is_sorted ? (this.sort.is_descending ? "▼" : "▲") : "";
    }
  }
}
