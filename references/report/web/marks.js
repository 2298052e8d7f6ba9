// What is drawn over the pictures: the pixel that was picked, and the pixels over the tolerance.

const most_marks = 20000;

function box(context, transform, {x, y}, least) {
  const side = Math.max(transform.k, least);
  const [cx, cy] = transform.apply([x + 0.5, y + 0.5]);
  context.strokeRect(cx - side / 2, cy - side / 2, side, side);
}

function outline(context, width, colour, draw) {
  context.lineWidth = width;
  context.strokeStyle = colour;
  draw();
}

/** Dark below light: seen on every ground. */
function twice(context, colour, draw) {
  outline(context, 3, "#000", draw);
  outline(context, 1.25, colour, draw);
}

export function draw_marks(context, transform, {over, picked}) {
  for (const pixel of over.slice(0, most_marks)) {
    twice(context, pixel.is_unexplained ? "#ff5a6a" : "#ffd84d", () => box(context, transform, pixel, pixel.is_unexplained ? 9 : 6));
  }
  if (picked) twice(context, "#fff", () => box(context, transform, picked, 15));
}

/** Pixels with a cause, and those that are not finite. */
export function marked_pixels(picture, causes) {
  const unexplained = causes.indexOf("unexplained") + 1;
  const ignored = causes.indexOf("ignored") + 1;
  const found = [];
  for (let i = 0; i < picture.causes.length; ++i) {
    const cause = picture.causes[i];
    if (ignored > 0 && cause === ignored) continue;
    if (cause === 0 && !Number.isNaN(picture.errors[i])) continue;
    found.push({x: i % picture.width, y: Math.floor(i / picture.width), is_unexplained: cause === 0 || cause === unexplained});
  }
  return found;
}
