// The pixel budget: how many pixels over the tolerance have which cause.
import {element} from "./dom.js";
import {count, words} from "./format.js";

let known = [];  // {name, colour}

/** The causes of the report, in their order; others have a colour of the style sheet, or the common one. */
export function know_causes(causes) { known = causes; }

const place = (cause) => known.findIndex(({name}) => name === cause);

/** Attributes of what shows a cause by its colour. */
export function cause_look(cause, classes = "", style = {}) {
  const colour = known[place(cause)]?.colour;
  return {class: `${classes} cause cause-${cause}`, style: {...style, ...(colour ? {background: colour} : {})}};
}

/** [cause, pixels] of those that occur, the unexplained first. */
export function parts(budget) {
  const rank = (cause) => (cause === "unexplained" ? -1 : place(cause) < 0 ? known.length : place(cause));
  return Object.entries(budget ?? {}).filter(([, n]) => n > 0).sort((a, b) => rank(a[0]) - rank(b[0]));
}

function sentence(budget) {
  return parts(budget).map(([cause, n]) => `${count(n)} ${words(cause)}`).join(", ");
}

export function bar(budget) {
  const segments = parts(budget).map(([cause, n]) =>
    element("span", {title: `${words(cause)}: ${count(n)}`, ...cause_look(cause, "", {"flex-grow": n})}));
  return element("span", {class: "budget", role: "img", "aria-label": `Pixel budget: ${sentence(budget) || "nothing over"}`},
    segments);
}

export function legend(budget) {
  const total = parts(budget).reduce((sum, [, n]) => sum + n, 0);
  const lines = parts(budget).map(([cause, n]) => element("li", {},
    element("span", {"aria-hidden": "true", ...cause_look(cause, "key")}),
    element("span", {class: "grow"}, words(cause)),
    element("span", {class: "number"}, count(n)),
    element("span", {class: "number share"}, `${(100 * n / total).toFixed(1)} %`)));
  return element("ul", {class: "legend"}, lines);
}
