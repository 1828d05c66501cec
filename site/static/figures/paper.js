/** What all figures share: a sheet whose y points up, points to move, and what elements.js has. */
import { clamp, html, number, soon, svg } from "./elements.js";
import { between, minus, plus } from "./vectors.js";

export * from "./elements.js";

const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1],
               PageDown: [0, -4], PageUp: [0, 4], Enter: [0, 0], " ": [0, 0],
               Home: [-Infinity, -Infinity], End: [Infinity, Infinity] };
const DISC = 12;                          // a handle's radius, in CSS pixels
const REACH = { touch: 22, mouse: 14 };   // how far from its middle it is still gripped
const STILL = 5;                          // a pointer that moves less is a tap

const inNumbers = ([x, y]) => `x ${number(x)}, y ${number(y)}`;

/** The nearest point on whole steps, counted from `from`, in the limits [x0, x1, y0, y1]. */
const snapped = (point, { step, from = [0, 0], limits }) => point.map((t, k) => clamp(
  from[k] + Math.round((t - from[k]) / step) * step, limits[2 * k], limits[2 * k + 1]));

/** A drawing of x0 ... x1 times y0 ... y1. Its elements are in CSS pixels, so that text and lines
 *  have one size on all screens: draw() is called again when the width changes, and when one of
 *  its handles has moved. Each element has a style, a class of figures.css, and may have css. */
export class Sheet {
  constructor([x0, x1, y0, y1], label, draw) {
    Object.assign(this, { x0, x1, y0, y1, handles: [] });
    this.svg = svg("svg", { role: "img", "aria-label": label });
    this.box = html("div", { class: "sheet" }, this.svg);
    this.box.style.aspectRatio = (x1 - x0) / (y1 - y0);
    this.redraw = () => soon(draw);
    const isHidden = () => this.box.clientWidth === 0;
    new ResizeObserver(() => isHidden() || this.redraw()).observe(this.box);
    this.followPointers();
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

  /** Shows elements, and the handles at their places. */
  draw(...elements) {
    this.svg.replaceChildren(...elements.flat(Infinity));
    for (const handle of this.handles) handle.show();
  }

  rectangle([x, y], width, height, style, css) {
    const [left, top] = this.place([x, y + height]);
    return svg("rect", { x: left, y: top, class: style, style: css,
                         width: width * this.scale, height: height * this.scale });
  }

  line(points, style, css) {
    return svg("polyline", { points: points.map((p) => this.place(p)).join(" "),
                             class: style, style: css });
  }

  polygon(points, style, css) {
    return svg("polygon", { points: points.map((p) => this.place(p)).join(" "),
                            class: style, style: css });
  }

  /** radius: in CSS pixels. */
  dot(point, radius, style, css) {
    const [cx, cy] = this.place(point);
    return svg("circle", { cx, cy, r: radius, class: style, style: css });
  }

  /** What is asked about: reach is in CSS pixels. */
  cross([x, y], reach = 10) {
    const far = reach / this.scale;
    return ["halo", "cross"].flatMap((style) => [
      this.line([[x - far, y], [x + far, y]], style),
      this.line([[x, y - far], [x, y + far]], style)]);
  }

  arrow(from, to, style) {
    const [x, y] = minus(to, from), length = this.scale * Math.hypot(x, y);
    if (length < 1) return [];
    const head = Math.min(1, 12 / length), neck = between(to, from, head);
    const corner = (side) => plus(neck, [-y, x], side * head / 2);
    return [this.line([from, neck], `${style} stem`),
            this.polygon([to, corner(1), corner(-1)], style)];
  }

  /** shift: in CSS pixels, right and up. */
  text(point, text, style, [right, up] = [0, 0]) {
    const [x, y] = this.place(point);
    return svg("text", { x: x + right, y: y - up, class: style }, text);
  }

  /** A point to drag, or to move with the keys of a slider (Shift: four steps at once). It stands
   *  where at() says. said(point) is what a screen reader says of it. moved(point, true, isPressed)
   *  is called when the reader has moved it, or pressed it: with Enter or Space, a probe by a tap.
   *  -> show(), go(point, isPressed), point(), element */
  handle({ name, mark = "", style = "", at, moved, said = inNumbers, ...grid }) {
    const axis = grid.limits[0] < grid.limits[1] ? 0 : 1; // of the one value that a slider has
    const element = html("div", { class: `handle ${style}`, role: "slider", tabindex: 0,
                                  "aria-label": `${name}, moved by the arrow keys`,
                                  "aria-valuemin": grid.limits[2 * axis],
                                  "aria-valuemax": grid.limits[2 * axis + 1] }, mark);
    let point;
    const show = () => {
      point = snapped(at(), grid);
      element.style.left = `${100 * (point[0] - this.x0) / (this.x1 - this.x0)}%`;
      element.style.top = `${100 * (this.y1 - point[1]) / (this.y1 - this.y0)}%`;
      element.setAttribute("aria-valuenow", point[axis]);
      element.setAttribute("aria-valuetext", said(point));
    };
    const go = (to, isPressed = false) => {
      moved(snapped(to, grid), true, isPressed); // chosen, not only pointed at
      show();
      this.redraw();
    };
    element.addEventListener("keydown", (event) => {
      const direction = KEYS[event.key];
      if (!direction) return;
      event.preventDefault();
      go(plus(point, direction, (event.shiftKey ? 4 : 1) * grid.step), !direction.some(Boolean));
    });
    show();
    this.box.append(element);
    const handle = { show, go, point: () => point, element };
    this.handles.push(handle);
    return handle;
  }

  /** The point that the reader asks about: a handle, which a click or a tap brings to any place.
   *  While a mouse hovers, moved() gets the place under it; when it leaves, the chosen place. */
  probe(options) {
    this.chosen = this.handle({ ...options, style: "probe" });
    const pointAt = (to) => {
      options.moved(to, false);
      this.redraw();
    };
    this.box.addEventListener("pointermove", (event) => {
      if (event.pointerType !== "mouse" || event.buttons) return;
      pointAt(snapped(this.pointOf(event), options));
    });
    this.box.addEventListener("pointerleave", () => pointAt(this.chosen.point()));
  }

  /** -> the handle that a pointer means, if one is near, and whether the pointer is on its disc. */
  under(event) {
    const at = this.place(this.pointOf(event));
    const near = this.handles.flatMap((handle) => {
      const distance = Math.hypot(...minus(at, this.place(handle.point())));
      const fromDisc = handle === this.chosen ? distance : distance - DISC;
      return distance <= (REACH[event.pointerType] ?? REACH.mouse) ? { handle, fromDisc } : [];
    }).sort((a, b) => a.fromDisc - b.fromDisc)[0];
    return { handle: near?.handle, isOnDisc: near?.fromDisc <= 0 };
  }

  /** Handles take no pointer themselves: a browser would send them the taps that are for the
   *  pixels around them. A finger near one does not scroll the page. Elsewhere, and on the chosen
   *  place, a swipe up or down does. */
  followPointers() {
    let down = null;
    const isMeant = ({ pointerId }) => pointerId === down?.pointerId;
    const on = (kind, listener, options) => this.box.addEventListener(kind, listener, options);
    on("pointerdown", (event) => {
      if (event.button !== 0 || down) return;
      const under = this.under(event);
      down = { ...under, pointerId: event.pointerId, at: this.pointOf(event),
               from: under.handle?.point(), isDragged: false };
      this.box.setPointerCapture(event.pointerId);
    });
    on("touchstart", (event) => {
      const isKnob = down?.handle && down.handle !== this.chosen;
      if (isKnob && event.cancelable) event.preventDefault();
    }, { passive: false });
    on("pointermove", (event) => {
      if (!down) this.box.classList.toggle("grips", Boolean(this.under(event).handle));
      if (!isMeant(event)) return;
      const by = minus(this.pointOf(event), down.at);
      down.isDragged ||= Math.hypot(...by) * this.scale > STILL;
      if (down.isDragged) down.handle?.go(plus(down.from, by));
    });
    on("pointerup", (event) => {
      if (!isMeant(event)) return;
      const isTap = !down.isDragged && !down.isOnDisc;
      if (isTap) this.chosen?.go(down.at, true);
      const meant = isTap ? this.chosen : down.handle;
      meant?.element.focus({ preventScroll: true, focusVisible: false });
    });
    on("pointercancel", (event) => isMeant(event) && down.handle?.go(down.from)); // it scrolls
    on("lostpointercapture", (event) => {
      if (isMeant(event)) down = null;
    });
  }
}
