// Values to what a screen shows.
import {packed} from "./heat.js";

const opaque = 255 << 24;
const magenta = (opaque | 255 << 16 | 255) >>> 0;
const black = opaque >>> 0;
const grey = (opaque | 0x909090) >>> 0;
const dark_grey = (opaque | 0x505050) >>> 0;
const levels = 1 << 14;

/** IEC 61966-2-1; without it, the values themselves. */
function curve(is_srgb) {
  return Uint8Array.from({length: levels}, (_, i) => {
    const c = i / (levels - 1);
    const shown = !is_srgb ? c : c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
    return Math.round(255 * shown);
  });
}

const curves = {srgb: curve(true), linear: curve(false)};

/** Pixels that are not finite: a chequer of magenta and black, which no shading makes. */
const warning = (i, width) => ((i % width) + Math.floor(i / width)) % 2 === 0 ? magenta : black;

function canvas_of(picture, colour) {
  const canvas = document.createElement("canvas");
  canvas.width = picture.width;
  canvas.height = picture.height;
  const data = new ImageData(picture.width, picture.height);
  const out = new Uint32Array(data.data.buffer);
  for (let i = 0; i < out.length; ++i) out[i] = colour(i);
  canvas.getContext("2d").putImageData(data, 0, 0);
  return canvas;
}

export function shaded(picture, values, exposure, is_srgb) {
  const table = is_srgb ? curves.srgb : curves.linear;
  const gain = 2 ** exposure * (levels - 1);
  const level = (c) => table[c > 0 ? Math.min(c * gain + 0.5, levels - 1) | 0 : 0];
  return canvas_of(picture, (i) => {
    const r = values[3 * i], g = values[3 * i + 1], b = values[3 * i + 2];
    if (!Number.isFinite(r + g + b)) return warning(i, picture.width);
    return (opaque | level(b) << 16 | level(g) << 8 | level(r)) >>> 0;
  });
}

/** Pixels that were not compared: a hatching of greys, which no error has. */
const hatching = (i, width) => (((i % width) + Math.floor(i / width)) % 4 < 2 ? grey : dark_grey);

/** `ignored`: the number of that cause, 0 when there is none. */
export function heat_map(picture, range, ignored) {
  const step = (packed.length - 1) / (range.high - range.low);
  return canvas_of(picture, (i) => {
    if (ignored > 0 && picture.causes[i] === ignored) return hatching(i, picture.width);
    const error = picture.errors[i];
    if (Number.isNaN(error)) return warning(i, picture.width);
    if (error === 0) return black;
    const at = Math.round((Math.log10(error) - range.low) * step);
    return packed[Math.max(0, Math.min(packed.length - 1, at))];
  });
}
