// The report's data: scenes, and their pictures decoded when they are looked at.
import {decoded} from "./picture.js";

const kept_pictures = 4;
const waiting = new Map();
const decoded_pictures = new Map();

// What a side file calls.
window.plumb_picture = (id, text) => waiting.get(id)?.(text);

/** Scenes under keys that are unique, so that each has an address of its own. */
function with_keys(scenes) {
  const seen = new Map();
  return scenes.map((scene, index) => {
    const times = (seen.get(scene.name) ?? 0) + 1;
    seen.set(scene.name, times);
    return {...scene, index, result: scene.result ?? {}, key: times === 1 ? scene.name : `${scene.name}~${times}`};
  });
}

export function read_report() {
  const report = JSON.parse(document.getElementById("report-data").textContent);
  return {...report, scenes: with_keys(report.scenes)};
}

function text_beside(id) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    const done = () => { waiting.delete(id); script.remove(); };
    waiting.set(id, (text) => { done(); resolve(text); });
    script.onerror = () => { done(); reject(new Error(`pictures/${id}.js cannot be read; it belongs beside index.html`)); };
    script.src = `pictures/${id}.js`;
    document.head.append(script);
  });
}

async function load(scene) {
  const inline = document.getElementById(`picture-${scene.picture}`);
  return decoded(inline ? inline.textContent : await text_beside(scene.picture), scene);
}

/** A promise of the pixels; the last few pictures stay decoded. */
export function picture_of(scene) {
  const found = decoded_pictures.get(scene.picture) ?? load(scene);
  decoded_pictures.delete(scene.picture);
  decoded_pictures.set(scene.picture, found);
  found.catch(() => decoded_pictures.delete(scene.picture));
  if (decoded_pictures.size > kept_pictures) decoded_pictures.delete(decoded_pictures.keys().next().value);
  return found;
}
