// Keyboard shortcuts: one list, from which they act and are documented.

export const shortcuts = [
  {keys: ["1", "2", "3", "4"], text: "slider, side by side, blink, difference", action: "mode_number"},
  {keys: [" "], shown: "Space", text: "swap right and yours (when blinking)", action: "swap"},
  {keys: ["+", "="], shown: "+", text: "zoom in", action: "zoom_in"},
  {keys: ["-"], text: "zoom out", action: "zoom_out"},
  {keys: ["0"], text: "fit the picture", action: "fit"},
  {keys: ["e"], text: "brighter by half a stop", action: "brighter"},
  {keys: ["d"], text: "darker by half a stop", action: "darker"},
  {keys: ["r"], text: "reset the exposure", action: "reset_exposure"},
  {keys: ["s"], text: "sRGB curve on or off", action: "toggle_curve"},
  {keys: ["m"], text: "mark pixels over the tolerance", action: "toggle_marks"},
  {keys: ["w"], text: "go to the worst pixel", action: "worst"},
  {keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"], shown: "Arrows", text: "move the picked pixel (on a picture)", action: "move_pixel"},
  {keys: ["j", "n"], shown: "j or n", text: "next scene", action: "next"},
  {keys: ["k", "p"], shown: "k or p", text: "previous scene", action: "previous"},
  {keys: ["o", "Escape"], shown: "o or Esc", text: "overview", action: "overview"},
  {keys: ["/"], text: "filter the results", action: "filter"},
  {keys: ["?"], text: "this help", action: "help"},
];

const is_typing = (node) => node.matches?.("input:not([type=range]), select, textarea");
/** Keys that mean something to the element itself are left to it. */
const is_its_own = (node, key) => (key === " " && node.matches?.("button, a, summary, input")) ||
  (key.startsWith("Arrow") && !node.matches?.(".pane canvas"));

/** `actions()` are those of the current view, by name; what it lacks does nothing. */
export function listen(actions, settings) {
  document.addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || document.querySelector("dialog[open]")) return;
    if (is_typing(e.target) && e.key !== "Escape") return;
    if (is_typing(e.target)) { e.target.blur(); return; }
    if (!settings.has_shortcuts && e.key.length === 1) return;
    const found = shortcuts.find((each) => each.keys.includes(e.key));
    const act = found && !is_its_own(e.target, e.key) && actions()[found.action];
    if (!act) return;
    e.preventDefault();
    act(e);
  });
}
