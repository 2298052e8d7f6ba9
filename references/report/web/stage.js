// The panes of one scene: which there are, what each shows, and their common zoom.
import {element} from "./dom.js";
import {common_range, range_of, scale} from "./heat.js";
import {marked_pixels} from "./marks.js";
import {Pane} from "./pane.js";
import {heat_map, shaded} from "./shading.js";
import {make_divider} from "./slider.js";

const titles = {reference: "Right", test: "Yours", error: "Difference"};
const blink_milliseconds = 600;

export class Stage {
  /** `view` is shared with the toolbar; `on_point(pixel or null)`, `on_pick(pixel)`, `on_zoom(k)`; the
   * button that changes the range of colours stands beside their scale. */
  constructor(view, range_button, callbacks) {
    this.range_button = range_button;
    this.view = view;
    this.callbacks = callbacks;
    this.panes_node = element("div", {class: "panes"});
    this.legend = element("div", {class: "scale-place"});
    this.node = element("section", {class: "stage", "aria-label": "Pictures"}, this.panes_node, this.legend);
    this.divider = make_divider(() => this.redraw());
    this.shown = "reference";
    this.sources = {};
    this.is_fitting = true;
    new ResizeObserver(() => this.resized()).observe(this.panes_node);
  }

  /** `encoded`: whether the file of the picture of that name holds what a screen shows. */
  show(picture, {causes, encoded}) {
    const is_alike = this.picture?.width === picture.width && this.picture.height === picture.height;
    this.picture = picture;
    this.encoded = encoded;
    this.marked = marked_pixels(picture, causes);
    this.ignored = causes.indexOf("ignored") + 1;
    this.sources = {};
    this.picked = null;
    if (!is_alike) this.is_fitting = true;
    this.arrange();
  }

  /** Makes the panes of the current mode. */
  arrange() {
    const {mode} = this.view;
    const names = mode === "side" ? ["reference", "test", "error"] : [mode];
    this.panes = names.map((name) => this.new_pane(name));
    this.panes_node.replaceChildren(...this.panes.map((pane) => pane.node));
    this.panes_node.dataset.mode = mode;
    if (mode === "slider") this.panes[0].node.append(this.divider.node);
    this.divider.move(this.divider.place());
    for (const pane of this.panes) pane.set_picture(this.picture);
    this.update_legend();
    this.update_blinking();
    this.apply(this.is_fitting ? this.panes[0].fitting() : this.recentred());
  }

  new_pane(name) {
    const what = {slider: "The right picture, and yours beyond the line", blink: "The right picture and yours in turn"}[name] ?? titles[name];
    const pane = new Pane(`${what}. Arrow keys move the picked pixel.`, {
      on_zoom: (transform) => { this.is_fitting = false; this.apply(transform); },
      on_point: this.callbacks.on_point,
      on_pick: this.callbacks.on_pick,
    });
    pane.name = name;
    return pane;
  }

  /** The old transform moved so that the middle of a pane stays the middle, though panes changed their size. */
  recentred() {
    const {clientWidth, clientHeight} = this.panes[0].canvas;
    const {k} = this.transform;
    return this.transform.translate((clientWidth - this.size.width) / 2 / k, (clientHeight - this.size.height) / 2 / k);
  }

  apply(transform) {
    const {clientWidth: width, clientHeight: height} = this.panes[0].canvas;
    this.transform = transform;
    this.size = {width, height};
    this.callbacks.on_zoom(transform.k);
    this.redraw();
  }

  fit() { this.is_fitting = true; this.apply(this.panes[0].fitting()); }
  scale_by(factor) { this.panes[0].scale_by(factor); }
  scale_to(k) { this.panes[0].scale_to(k); }

  /** Shows a pixel as picked; `is_sought` moves it into view. */
  pick(pixel, is_sought) {
    this.picked = pixel;
    if (is_sought && pixel) this.panes[0].center(pixel);
    else this.redraw();
  }

  resized() {
    if (!this.picture || !this.panes_node.isConnected) return;
    if (this.is_fitting) this.fit();
    else this.redraw();
  }

  /** A picture as the screen shows it, made when it is first needed. */
  source(name) {
    const {exposure, is_srgb} = this.view;
    this.sources[name] ??= name === "error" ? heat_map(this.picture, this.range(), this.ignored)
      : shaded(this.picture, this.picture[name], exposure, is_srgb && !this.encoded[name]);
    return this.sources[name];
  }

  range() { return this.view.is_own_range ? range_of(this.picture.errors) : common_range; }

  /** After the exposure, the curve or the range changed. */
  reshade() {
    this.sources = {};
    this.update_legend();
    this.redraw();
  }

  update_legend() {
    const is_shown = ["side", "error"].includes(this.view.mode);
    this.legend.replaceChildren(...(is_shown ? [scale(this.range()), this.range_button] : []));
  }

  update_blinking() {
    clearInterval(this.timer);
    if (this.view.mode !== "blink" || this.view.is_paused) return;
    this.timer = setInterval(() => this.swap(), blink_milliseconds);
  }

  swap() {
    this.shown = this.shown === "reference" ? "test" : "reference";
    this.redraw();
  }

  stop() { clearInterval(this.timer); }

  layers(name) {
    if (name === "slider") {
      const at = this.divider.place();
      return [{name: "reference", from: 0, to: at}, {name: "test", from: at, to: 1}];
    }
    return [{name: name === "blink" ? this.shown : name, from: 0, to: 1}];
  }

  redraw() {
    if (!this.picture || !this.transform || this.is_waiting) return;
    this.is_waiting = true;
    requestAnimationFrame(() => { this.is_waiting = false; this.draw(); });
  }

  draw() {
    const marks = {over: this.view.has_marks ? this.marked : [], picked: this.picked};
    for (const pane of this.panes) {
      const layers = this.layers(pane.name);
      pane.node.dataset.shows = layers.map((layer) => layer.name).join(" ");
      pane.chips.replaceChildren(...layers.map((layer) => element("span", {class: "chip"}, titles[layer.name])));
      pane.draw(this.transform, layers.map((layer) => ({...layer, source: this.source(layer.name)})), marks);
    }
  }
}
