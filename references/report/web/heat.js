// Errors as colours: inferno (perceptually uniform; van der Walt and Smith, 2015) on a logarithmic scale.
import {inferno} from "d3-scale-chromatic/src/sequential-multi/viridis.js";
import {element, svg} from "./dom.js";

const steps = 256;
/** The range of the thumbnails and, unless changed, of all scenes, so that they compare. */
export const common_range = {low: -8, high: 0};

function components(t) {
  const hex = inferno(t);
  return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
}

const table = Array.from({length: steps}, (_, i) => components(i / (steps - 1)));

/** Colours as the bytes of ImageData, ready to be looked up. */
export const packed = Uint32Array.from(table, ([r, g, b]) => (255 << 24 | b << 16 | g << 8 | r) >>> 0);

/** Decades that hold the errors of one picture. */
export function range_of(errors) {
  let largest = 0;
  for (const error of errors) if (error > largest) largest = error;
  const high = largest > 0 ? Math.ceil(Math.log10(largest)) : 0;
  return {low: high - 6, high};
}

export function scale(range) {
  const colours = Array.from({length: 17}, (_, i) => `rgb(${table[Math.round(i * 255 / 16)].join(" ")})`);
  const decades = Array.from({length: range.high - range.low + 1}, (_, i) => range.low + i);
  const label = (d, i) => (d === 0 ? "1" : `${i === 0 ? "≤ " : ""}1e${d}`);
  return element("div", {class: "scale", role: "img",
    "aria-label": `Colour scale of the difference, logarithmic, from 1e${range.low} (dark) to 1e${range.high} (bright)`},
  element("div", {class: "ramp", style: {background: `linear-gradient(to right, ${colours.join(",")})`}}),
  element("div", {class: "ticks"}, decades.map((d, i) => element("span", {}, label(d, i)))));
}

/** Colours the grey error thumbnails. */
export function thumbnail_filter() {
  const row = (channel) => Array.from({length: 33}, (_, i) => (table[Math.round(i * 255 / 32)][channel] / 255).toFixed(4));
  const functions = ["R", "G", "B"].map((name, channel) =>
    svg(`feFunc${name}`, {type: "table", tableValues: row(channel).join(" ")}));
  return svg("svg", {width: 0, height: 0, class: "hidden", "aria-hidden": "true"},
    svg("filter", {id: "inferno", "color-interpolation-filters": "sRGB"}, svg("feComponentTransfer", {}, functions)));
}
