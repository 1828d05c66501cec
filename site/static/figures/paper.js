/** What all figures share: a sheet whose y points up, points to move, and what elements.js has. */
import { clamp, html, number, svg } from "./elements.js";

export * from "./elements.js";

const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };

/** The nearest point on whole steps, counted from `from`, in the limits [x0, x1, y0, y1]. */
const snapped = (point, { step, from = [0, 0], limits }) => point.map((t, k) => clamp(
  from[k] + Math.round((t - from[k]) / step) * step, limits[2 * k], limits[2 * k + 1]));

/** A drawing of x0 ... x1 times y0 ... y1. Its elements are in CSS pixels, so that text and lines
 *  have one size on all screens: draw() is called again when the width changes. */
export class Sheet {
  constructor([x0, x1, y0, y1], label, draw) {
    Object.assign(this, { x0, x1, y0, y1 });
    this.svg = svg("svg", { role: "img", "aria-label": label });
    this.box = html("div", { class: "sheet" }, this.svg);
    this.box.style.aspectRatio = (x1 - x0) / (y1 - y0);
    new ResizeObserver(draw).observe(this.box);
  }

  get scale() {
    return this.box.clientWidth / (this.x1 - this.x0);
  }

  place([x, y]) {
    return [(x - this.x0) * this.scale, (this.y1 - y) * this.scale];
  }

  pointOf(event) {
    const { left, top } = this.svg.getBoundingClientRect();
    return [this.x0 + (event.clientX - left) / this.scale,
            this.y1 - (event.clientY - top) / this.scale];
  }

  draw(...elements) {
    this.svg.replaceChildren(...elements.flat(2));
  }

  rectangle([x, y], width, height, style) {
    const [left, top] = this.place([x, y + height]);
    return svg("rect", { x: left, y: top, class: style,
                         width: width * this.scale, height: height * this.scale });
  }

  line(points, style) {
    return svg("polyline", { points: points.map((p) => this.place(p)).join(" "), class: style });
  }

  dot(point, radius, style) {
    const [cx, cy] = this.place(point);
    return svg("circle", { cx, cy, r: radius, class: style });
  }

  arrow(from, to, style) {
    const [[x0, y0], [x1, y1]] = [this.place(from), this.place(to)];
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length < 1) return [];
    const [dx, dy] = [(x1 - x0) / length, (y1 - y0) / length];
    const head = Math.min(12, length);
    const side = (s) => [x1 - head * dx - s * dy * head / 2, y1 - head * dy + s * dx * head / 2];
    const stem = [x1 - head * dx, y1 - head * dy];
    return [svg("polyline", { points: [[x0, y0], stem].join(" "), class: `${style} stem` }),
            svg("polygon", { points: [[x1, y1], side(1), side(-1)].join(" "), class: style })];
  }

  /** shift: in CSS pixels, right and up. */
  text(point, text, style, [right, up] = [0, 0]) {
    const [x, y] = this.place(point);
    return svg("text", { x: x + right, y: y - up, class: style }, text);
  }

  /** A point to drag, or to move with the arrow keys (Shift: four steps at once).
   *  moved(point) is called when it has moved. -> set(point), go(point): set and tell, point() */
  handle({ name, mark = "", style = "", at, moved, ...grid }) {
    const element = html("div", { class: `handle ${style}`, role: "slider", tabindex: 0,
                                  "aria-label": `${name}, moved by the arrow keys`,
                                  "aria-valuemin": grid.limits[0],
                                  "aria-valuemax": grid.limits[1] }, mark);
    let point, grip = null;
    const set = (to) => {
      point = snapped(to, grid);
      element.style.left = `${100 * (point[0] - this.x0) / (this.x1 - this.x0)}%`;
      element.style.top = `${100 * (this.y1 - point[1]) / (this.y1 - this.y0)}%`;
      element.setAttribute("aria-valuenow", point[0]);
      element.setAttribute("aria-valuetext", `x ${number(point[0])}, y ${number(point[1])}`);
    };
    const go = (to) => {
      set(to);
      moved(point, true); // chosen, not only pointed at
    };
    element.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      const at = this.pointOf(event);
      grip = [point[0] - at[0], point[1] - at[1]];
      element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
      if (grip) go(this.pointOf(event).map((t, k) => t + grip[k]));
    });
    element.addEventListener("lostpointercapture", () => { grip = null; });
    element.addEventListener("keydown", (event) => {
      const direction = KEYS[event.key];
      if (!direction) return;
      event.preventDefault();
      const far = (event.shiftKey ? 4 : 1) * grid.step;
      go([point[0] + far * direction[0], point[1] + far * direction[1]]);
    });
    set(at);
    this.box.append(element);
    return { set, go, point: () => point };
  }

  /** The point that the reader asks about: a handle, which a click or a tap brings to any place.
   *  While a mouse hovers, moved() gets the place under it; when it leaves, the chosen place. */
  probe(options) {
    const chosen = this.handle({ ...options, style: "probe" });
    const isElsewhere = (event) => event.target.closest(".handle:not(.probe)");
    this.box.addEventListener("click", (event) => {
      if (!isElsewhere(event)) chosen.go(this.pointOf(event));
    });
    this.box.addEventListener("pointermove", (event) => {
      if (event.pointerType !== "mouse" || event.buttons) return;
      options.moved(snapped(this.pointOf(event), options));
    });
    this.box.addEventListener("pointerleave", () => options.moved(chosen.point()));
    return chosen;
  }
}
