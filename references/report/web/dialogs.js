// Help and licences.
import licences from "./LICENSES.md";
import {element} from "./dom.js";
import {shortcuts} from "./keys.js";

function dialog(id, title, ...children) {
  const close = element("button", {type: "button", class: "small", onclick: () => node.close()}, "Close");
  const node = element("dialog", {id, "aria-labelledby": `${id}-title`},
    element("div", {class: "dialog-head"}, element("h2", {id: `${id}-title`}, title), close), ...children);
  node.addEventListener("click", (e) => { if (e.target === node) node.close(); });
  return node;
}

export function make_help(settings) {
  const rows = shortcuts.map(({keys, shown, text}) => element("tr", {},
    element("th", {scope: "row"}, (shown ? [shown] : keys).map((key) => element("kbd", {}, key))), element("td", {}, text)));
  const is_on = element("input", {type: "checkbox", id: "has-shortcuts", checked: true,
    onchange: () => { settings.has_shortcuts = is_on.checked; }});
  return dialog("help", "Keyboard", element("table", {class: "pairs"}, element("tbody", {}, rows)),
    element("p", {}, is_on, element("label", {for: "has-shortcuts"}, " Single keys act as shortcuts")),
    element("p", {class: "muted"}, "Wheel or pinch zooms, dragging moves, in all panes at once. Pixels that are not finite are chequered magenta."));
}

export function make_about(report) {
  return dialog("about", "About", element("p", {}, `Made by plumb ${report.version}. The page loads nothing from a network.`),
    element("pre", {tabindex: "0", "aria-label": "Licences"}, licences));
}
