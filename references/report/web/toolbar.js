// How the pictures are looked at: mode, exposure, curve, marks, zoom.
import {element} from "./dom.js";

export const modes = [["slider", "Slider"], ["side", "Side by side"], ["blink", "Blink"], ["error", "Difference"]];
export const most_stops = 16;

function toggle(label, title, on_click) {
  return element("button", {type: "button", "aria-pressed": "false", title, onclick: on_click}, label);
}

const press = (button, is_pressed) => button.setAttribute("aria-pressed", String(is_pressed));

/** `actions` are those of keys.js by name. */
export function make_toolbar(view, actions) {
  const mode_buttons = modes.map(([mode, label], i) => toggle(label, `${label} (${i + 1})`, () => actions.set_mode(mode)));
  const exposure = element("input", {type: "range", min: -most_stops, max: most_stops, step: "0.5", id: "exposure",
    oninput: () => actions.set_exposure(Number(exposure.value))});
  const stops = element("output", {for: "exposure", class: "number stops"});
  const curve = toggle("sRGB", "Show with the sRGB curve (s)", actions.toggle_curve);
  const as_filed = element("span", {class: "muted", title: "Files of 8 bits hold what a screen shows"}, "As in the files");
  const marks = toggle("Marks", "Mark pixels over the tolerance (m)", actions.toggle_marks);
  const pause = toggle("Pause", "Stop blinking; the space bar swaps", actions.toggle_pause);
  const range = toggle("Own range", "Colours for this scene's differences only", actions.toggle_range);
  const zoom_text = element("output", {class: "number zoom-text", "aria-label": "Zoom"});
  const button = (label, title, action) => element("button", {type: "button", title, "aria-label": title, onclick: action}, label);
  const node = element("div", {class: "toolbar", role: "toolbar", "aria-label": "View"},
    element("div", {class: "segments", role: "group", "aria-label": "Mode"}, mode_buttons),
    element("div", {class: "group"}, pause, marks, curve, as_filed),
    element("div", {class: "group"}, element("label", {for: "exposure"}, "Exposure"), exposure, stops,
      button("↺", "Reset exposure (r)", () => actions.set_exposure(0))),
    element("div", {class: "group"}, button("−", "Zoom out (-)", actions.zoom_out), zoom_text,
      button("+", "Zoom in (+)", actions.zoom_in), button("Fit", "Fit (0)", actions.fit), button("1:1", "One to one", actions.one_to_one)));
  const update = () => {
    mode_buttons.forEach((each, i) => press(each, modes[i][0] === view.mode));
    exposure.value = view.exposure;
    stops.textContent = `${view.exposure > 0 ? "+" : view.exposure < 0 ? "−" : ""}${Math.abs(view.exposure)} EV`;
    exposure.setAttribute("aria-valuetext", `${view.exposure} stops`);
    press(curve, view.is_srgb);
    press(marks, view.has_marks);
    press(pause, view.is_paused);
    press(range, view.is_own_range);
    pause.hidden = view.mode !== "blink";
  };
  /** Where both pictures are shown as their files hold them there is no curve to choose. */
  const set_encoded = (encoded) => {
    curve.hidden = encoded.reference && encoded.test;
    as_filed.hidden = !curve.hidden;
  };
  return {node, range, update, set_encoded, has_curve: () => !curve.hidden, set_zoom: (k) => { zoom_text.textContent = `${k < 0.1 ? (100 * k).toFixed(1) : Math.round(100 * k)} %`; }};
}
