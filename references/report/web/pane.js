// One canvas that shows layers of a picture, zoomed and panned.
import {event, select} from "d3-selection";
import {zoom, zoomIdentity} from "d3-zoom";
import {element} from "./dom.js";
import {draw_marks} from "./marks.js";

const largest_scale = 96;

export class Pane {
  /** `on_zoom(transform)`, `on_point(pixel or null)`, `on_pick(pixel)`. */
  constructor(label, callbacks) {
    this.canvas = element("canvas", {tabindex: "0", role: "img", "aria-label": label});
    this.chips = element("div", {class: "chips", "aria-hidden": "true"});
    this.node = element("div", {class: "pane"}, this.canvas, this.chips);
    this.layers = [];
    this.zoom = zoom().clickDistance(4).on("zoom", () => callbacks.on_zoom(event.transform));
    select(this.canvas).call(this.zoom).on("dblclick.zoom", null);
    this.canvas.addEventListener("pointermove", (e) => callbacks.on_point(this.pixel_at(e)));
    this.canvas.addEventListener("pointerleave", () => callbacks.on_point(null));
    this.canvas.addEventListener("click", (e) => { const p = this.pixel_at(e); if (p) callbacks.on_pick(p); });
  }

  set_picture(picture) {
    this.picture = picture;
    const {width, height} = picture;
    this.zoom.translateExtent([[-width / 4, -height / 4], [1.25 * width, 1.25 * height]]);
    this.zoom.scaleExtent([Math.min(1, this.fitting().k) / 2, Math.max(largest_scale, this.fitting().k)]);
  }

  /** The whole picture, in the middle. */
  fitting() {
    const {clientWidth: w, clientHeight: h} = this.canvas;
    const k = Math.max(1e-3, Math.min(w / this.picture.width, h / this.picture.height));
    return zoomIdentity.translate((w - k * this.picture.width) / 2, (h - k * this.picture.height) / 2).scale(k);
  }

  change(transform) { this.zoom.transform(select(this.canvas), transform); }
  scale_by(factor) { this.zoom.scaleBy(select(this.canvas), factor); }
  scale_to(k) { this.zoom.scaleTo(select(this.canvas), k); }

  /** Brings a pixel into the middle, large enough to be seen. */
  center(pixel) {
    const k = Math.max(this.canvas.__zoom.k, 8);
    const {clientWidth: w, clientHeight: h} = this.canvas;
    this.change(zoomIdentity.translate(w / 2 - k * (pixel.x + 0.5), h / 2 - k * (pixel.y + 0.5)).scale(k));
  }

  pixel_at(e) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = this.canvas.__zoom.invert([e.clientX - box.left, e.clientY - box.top]).map(Math.floor);
    return x >= 0 && y >= 0 && x < this.picture.width && y < this.picture.height ? {x, y} : null;
  }

  /** `layers`: [{source, from, to}], from and to as fractions of the pane's width. */
  draw(transform, layers, marks) {
    const {canvas} = this;
    const ratio = devicePixelRatio;
    canvas.__zoom = transform;  // where d3-zoom keeps it: so all panes go on from the same place
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    canvas.dataset.transform = [transform.k, transform.x, transform.y].join(" ");
    const context = canvas.getContext("2d");
    for (const {source, from, to} of layers) {
      context.save();
      context.beginPath();
      context.rect(from * canvas.width, 0, (to - from) * canvas.width, canvas.height);
      context.clip();
      context.setTransform(ratio * transform.k, 0, 0, ratio * transform.k, ratio * transform.x, ratio * transform.y);
      context.imageSmoothingEnabled = transform.k * ratio < 1;
      context.drawImage(source, 0, 0);
      context.restore();
    }
    context.scale(ratio, ratio);
    draw_marks(context, transform, marks);
  }
}
