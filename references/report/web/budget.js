// The pixel budget: how many pixels over the tolerance have which cause.
import {element} from "./dom.js";
import {count, words} from "./format.js";

const known = ["unexplained", "silhouette", "shadow_edge", "secondary_edge", "coincident", "reference_tolerance",
  "depth", "quantisation", "clamped", "undecided", "ignored"];

export const cause_class = (cause) => `cause cause-${known.includes(cause) ? cause : "other"}`;

/** [cause, pixels] of those that occur, the unexplained first. */
export function parts(budget) {
  const rank = (cause) => (known.includes(cause) ? known.indexOf(cause) : known.length);
  return Object.entries(budget ?? {}).filter(([, n]) => n > 0).sort((a, b) => rank(a[0]) - rank(b[0]));
}

function sentence(budget) {
  return parts(budget).map(([cause, n]) => `${count(n)} ${words(cause)}`).join(", ");
}

export function bar(budget) {
  const segments = parts(budget).map(([cause, n]) =>
    element("span", {class: cause_class(cause), title: `${words(cause)}: ${count(n)}`, style: {"flex-grow": n}}));
  return element("span", {class: "budget", role: "img", "aria-label": `Pixel budget: ${sentence(budget) || "nothing over"}`},
    segments);
}

export function legend(budget) {
  const total = parts(budget).reduce((sum, [, n]) => sum + n, 0);
  const lines = parts(budget).map(([cause, n]) => element("li", {},
    element("span", {class: `key ${cause_class(cause)}`, "aria-hidden": "true"}),
    element("span", {class: "grow"}, words(cause)),
    element("span", {class: "number"}, count(n)),
    element("span", {class: "number share"}, `${(100 * n / total).toFixed(1)} %`)));
  return element("ul", {class: "legend"}, lines);
}
