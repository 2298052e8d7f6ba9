// The line between reference and test, moved by pointer or keys.
import {element} from "./dom.js";

const step = 0.02;

export function make_divider(on_move) {
  let place = 0.5;
  const node = element("div", {class: "divider", role: "slider", tabindex: "0", "aria-label": "Line between reference and test",
    "aria-valuemin": "0", "aria-valuemax": "100"}, element("span", {class: "grip", "aria-hidden": "true"}, "⇔"));
  const move = (to) => {
    place = Math.max(0, Math.min(1, to));
    node.style.left = `${100 * place}%`;
    node.setAttribute("aria-valuenow", Math.round(100 * place));
    on_move(place);
  };
  node.addEventListener("pointerdown", (e) => { node.setPointerCapture(e.pointerId); e.preventDefault(); node.focus(); });
  node.addEventListener("pointermove", (e) => {
    if (!node.hasPointerCapture(e.pointerId)) return;
    const box = node.parentElement.getBoundingClientRect();
    move((e.clientX - box.left) / box.width);
  });
  node.addEventListener("keydown", (e) => {
    const to = {ArrowLeft: place - step, ArrowRight: place + step, Home: 0, End: 1}[e.key];
    if (to === undefined) return;
    e.preventDefault();
    e.stopPropagation();
    move(to);
  });
  return {node, move, place: () => place};
}
