// Why the picked pixel is what it is.
import {command} from "./clipboard.js";
import {element} from "./dom.js";
import {words} from "./format.js";
import {cause_at} from "./pixel.js";

export function explanation(scene, picture, pixel) {
  if (!pixel) return [element("p", {class: "hint"}, "Click a pixel, or press w for the worst.")];
  const text = picture.texts[pixel.y * picture.width + pixel.x];
  const cause = cause_at(picture, scene.causes, pixel);
  const head = `Pixel ${pixel.x}, ${pixel.y}${cause ? `: ${words(cause)}` : " is within the tolerance"}`;
  const asked = scene.explain ? `${scene.explain} ${pixel.x} ${pixel.y}` : "";
  return [
    element("p", {class: "place"}, head),
    text ? element("pre", {tabindex: "0", "aria-label": "Explanation"}, text) : null,
    asked ? element("p", {class: "hint"}, text ? "The whole ray tree:" : "This explains it, ray by ray:") : null,
    asked ? command(asked, "explain this pixel") : null,
    !text && !asked ? element("p", {class: "hint"}, "No scene is known, so there is no ray to follow.") : null,
  ].filter(Boolean);
}
