// Figures of a scene as tables.
import {element} from "./dom.js";
import {figure, seconds, words} from "./format.js";

const main_figures = ["max_error", "judged_error", "mean_error", "rms_error", "pixels_over", "unverified", "non_finite"];

/** [["metrics.flip.mean", 0.1], ...] of an object of objects. */
function flat(object, before = "") {
  return Object.entries(object ?? {}).flatMap(([key, value]) => {
    const name = before + words(key);
    if (Array.isArray(value)) return [[name, value.map((each) => figure(each)).join("  ")]];
    return value !== null && typeof value === "object" ? flat(value, `${name} · `) : [[name, value]];
  });
}

function pairs(rows) {
  return element("table", {class: "pairs"}, element("tbody", {}, rows.map(([name, value]) =>
    element("tr", {}, element("th", {scope: "row"}, name), element("td", {class: "number"}, figure(value, 4))))));
}

export function figures(scene) {
  const {result} = scene;
  const rows = main_figures.filter((key) => result[key] !== undefined).map((key) => [words(key), result[key]]);
  if (result.tolerance !== undefined) rows.push(["tolerance", result.tolerance]);
  if (scene.width) rows.push(["size", `${scene.width} × ${scene.height}`]);
  if (result.seconds !== undefined) rows.push(["CPU time", seconds(result.seconds)]);
  return pairs(rows);
}

export const bounds = (result) => pairs(flat(result.bounds));

export const metrics = (result) => pairs(flat(result.metrics));

/** One row a term, one column a figure. */
export function terms(result) {
  const names = Object.keys(result.terms);
  const columns = [...new Set(names.flatMap((name) => flat(result.terms[name]).map(([key]) => key)))];
  const head = element("tr", {}, ["term", ...columns].map((text) => element("th", {scope: "col"}, text)));
  const rows = names.map((name) => {
    const values = Object.fromEntries(flat(result.terms[name]));
    return element("tr", {}, element("th", {scope: "row"}, words(name)),
      columns.map((key) => element("td", {class: "number"}, figure(values[key], 4))));
  });
  return element("table", {class: "values"}, element("thead", {}, head), element("tbody", {}, rows));
}
