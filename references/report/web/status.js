// What became of a scene: a sign, a word and a colour, never a colour alone.
import {element} from "./dom.js";

const known = {
  error: {sign: "!", word: "trouble", rank: 0},
  differ: {sign: "≠", word: "differs", rank: 1},
  agree: {sign: "✓", word: "agrees", rank: 3},
};

export function describe(status) {
  return known[status] ?? {sign: "•", word: status, rank: 2};
}

export function badge(status) {
  const {sign, word} = describe(status);
  return element("span", {class: `badge status-${known[status] ? status : "other"}`},
    element("span", {class: "sign", "aria-hidden": "true"}, sign), word);
}
