// The values of the pixel under the pointer, or of the one that was picked.
import {cause_look} from "./budget.js";
import {element} from "./dom.js";
import {figure, float32, words} from "./format.js";

/** What is wrong with a pixel: its cause, or that it is not finite; nothing when it is within the tolerance. */
export function cause_at(picture, causes, {x, y}) {
  const i = y * picture.width + x;
  if (picture.causes[i] > 0) return causes[picture.causes[i] - 1];
  return Number.isNaN(picture.errors[i]) ? "not finite" : "";
}

function difference(right, shown) {
  if (Object.is(right, shown)) return "0";
  const apart = shown - right;
  return Number.isFinite(apart) ? (apart > 0 ? "+" : "") + figure(apart, 4) : float32(apart);
}

function row(channel, right, shown) {
  const cell = (text, name) => element("td", {class: "number", "data-cell": name}, text);
  const class_of = Number.isFinite(right) && Number.isFinite(shown) ? "" : "warning";
  return element("tr", {class: class_of}, element("th", {scope: "row"}, channel), cell(float32(right), "reference"),
    cell(float32(shown), "test"), cell(difference(right, shown), "difference"));
}

export function readout(picture, causes, pixel, origin) {
  if (!pixel) return [element("p", {class: "hint"}, "Point at a pixel to read it; click to explain it.")];
  const at = 3 * (pixel.y * picture.width + pixel.x);
  const cause = cause_at(picture, causes, pixel);
  const rows = ["R", "G", "B"].map((channel, i) => row(channel, picture.reference[at + i], picture.test[at + i]));
  const head = ["", "Right", "Yours", "Difference"].map((text) => element("th", {scope: "col"}, text));
  return [
    element("p", {class: "place"}, element("span", {class: "number"}, `x ${pixel.x}, y ${pixel.y}`),
      element("span", {class: "muted"}, origin),
      cause ? element("span", {class: "tag"}, element("span", {"aria-hidden": "true", ...cause_look(cause, "key")}), words(cause))
        : element("span", {class: "tag quiet"}, "within the tolerance")),
    element("table", {class: "values"}, element("thead", {}, element("tr", {}, head)), element("tbody", {}, rows)),
  ];
}
