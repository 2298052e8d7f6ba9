// A command to be copied.
import {element} from "./dom.js";

async function copy(code, button) {
  try {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = "Copied";
  } catch {
    getSelection().selectAllChildren(code);  // the browser forbids it: leave the text selected for Ctrl+C
    button.textContent = "Press Ctrl+C";
  }
  setTimeout(() => { button.textContent = "Copy"; }, 2000);
}

export function command(text, label) {
  const code = element("code", {tabindex: "0"}, text);
  const button = element("button", {type: "button", class: "small", "aria-label": `Copy: ${label}`,
    onclick: () => copy(code, button)}, "Copy");
  return element("div", {class: "command"}, code, button);
}
