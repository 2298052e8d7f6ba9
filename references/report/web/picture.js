// Pixels out of the report: the layout is described in references/report/picture.hpp.

async function inflated(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The values of a picture whose bytes stand apart by channel and significance. */
function unshuffled(bytes, pixels) {
  const bits = new Uint32Array(3 * pixels);
  for (let channel = 0; channel < 3; ++channel) {
    const at = 4 * channel * pixels;
    for (let i = 0, o = channel; i < pixels; ++i, o += 3) {
      bits[o] = bytes[at + i] | bytes[at + pixels + i] << 8 | bytes[at + 2 * pixels + i] << 16 |
        bytes[at + 3 * pixels + i] << 24;
    }
  }
  return bits;
}

/** Per pixel the largest difference, relative above 1: what a tolerance is held against. Not finite: NaN. */
function judged_errors(reference, test, pixels) {
  const errors = new Float32Array(pixels);
  for (let i = 0; i < pixels; ++i) {
    let largest = 0;
    for (let k = 3 * i; k < 3 * i + 3; ++k) {
      const error = Math.abs(test[k] - reference[k]) / Math.max(1, Math.abs(reference[k]));
      if (!(error <= largest)) largest = error;
      if (Number.isNaN(error)) break;
    }
    errors[i] = Number.isFinite(largest) ? largest : NaN;
  }
  return errors;
}

export async function decoded(base64, scene) {
  const {width, height} = scene;
  const pixels = width * height;
  const bytes = await inflated(base64);
  const reference = unshuffled(bytes, pixels);
  const test = unshuffled(bytes.subarray(12 * pixels), pixels);
  for (let i = 0; i < test.length; ++i) test[i] ^= reference[i];
  const values = {reference: new Float32Array(reference.buffer), test: new Float32Array(test.buffer)};
  return {
    width, height, ...values,
    causes: bytes.subarray(24 * pixels, 25 * pixels),
    texts: JSON.parse(new TextDecoder().decode(bytes.subarray(25 * pixels))),
    errors: judged_errors(values.reference, values.test, pixels),
  };
}
