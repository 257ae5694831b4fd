/** The timeline of keys: a row for every style variable, keys that are dragged in time and in value, and the playhead. */
import { formatNumber, html, setAttributes, svg } from "../dom";
import { strings } from "../strings/strings";
import { LEAST_GAP, moveKey, removeKey, type TimedValue, withValues } from "./keys";
import { pixelOf, type Scale, valueAt } from "./scale";
import { type Layout, layOut, lineOf, rowScale, ruler } from "./timeline_rows";

/** Arrow keys change a value by this share of its range; with Shift finely. */
const STEP = { coarse: 0.02, fine: 0.004 };

export interface TimelineListeners {
  /** The keys as they are now: those that are drawn are a frame of the screen old. */
  keys: () => readonly TimedValue[];
  onChoose: (key: number) => void;
  onEdit: (keys: readonly TimedValue[], gesture: string | undefined, chosen: number) => void;
  onSettle: () => void;
  onSeek: (secs: number) => void;
}

/** A style variable as the rows name it. */
export interface RowName {
  title: string;
  unit: string;
  digits: number;
}

export interface TimelineModel {
  rows: readonly RowName[];
  ranges: readonly { least: number; most: number }[];
  keys: readonly TimedValue[];
  chosen: number;
  length: number;
  /** The variables over the whole length, all of a moment behind each other. */
  way: Float32Array;
}

interface Drag {
  pointerId: number;
  /** Number of the key and its row; −1 while the playhead is dragged. */
  key: number;
  axis: number;
  /** From the key to where it was taken, pixels. */
  dx: number;
  dy: number;
}

export class Timeline {
  readonly element = html("div", { class: "keys" });
  readonly #listeners: TimelineListeners;
  readonly #root = svg("svg", { class: "keys-plot", role: "group", "aria-label": strings.keyStyle.timeline });
  readonly #picture = svg("g");
  readonly #played = svg("clipPath", { id: "keys-played" }, svg("rect", { x: 0, y: 0, height: 1000 }));
  readonly #head = svg(
    "g",
    { class: "maker-head", role: "slider", tabindex: 0, "aria-label": strings.keyStyle.time, "aria-valuemin": 0 },
    svg("line", { y1: 24 }),
    svg("path", { d: "M-6 22h12v8l-6 6-6-6z" }),
    svg("rect", { class: "keys-grip", x: -12, y: 14, width: 24, height: 28 }),
  );
  #model: TimelineModel | undefined;
  #layout: Layout = layOut(600, 184, 1, 1);
  #secs = 0;
  #values: readonly number[] = [];
  #readOuts: SVGElement[] = [];
  #drag: Drag | undefined;

  constructor(listeners: TimelineListeners) {
    this.#listeners = listeners;
    this.#root.append(svg("defs", {}, this.#played), this.#picture, this.#head);
    this.element.append(this.#root);
    this.#root.addEventListener("pointerdown", (event) => this.#onPointerDown(event));
    this.#root.addEventListener("pointermove", (event) => this.#onPointerMove(event));
    for (const type of ["pointerup", "pointercancel"] as const)
      this.#root.addEventListener(type, (event) => this.#onPointerEnd(event));
    this.#root.addEventListener("keydown", (event) => this.#onKey(event));
    this.#root.addEventListener("keyup", () => listeners.onSettle());
    new ResizeObserver(() => this.#draw()).observe(this.element);
  }

  show(model: TimelineModel): void {
    this.#model = model;
    this.#draw();
  }

  /** Puts the playhead at a time, at which the variables have these values. */
  setPlayhead(secs: number, values: readonly number[]): void {
    this.#secs = secs;
    this.#values = values;
    if (!this.#model) return;
    const x = pixelOf(this.#layout.time, secs);
    this.#head.setAttribute("transform", `translate(${x.toFixed(1)} 0)`);
    this.#played.firstElementChild!.setAttribute("width", Math.max(0, x).toFixed(1));
    setAttributes(this.#head, {
      "aria-valuenow": secs.toFixed(2),
      "aria-valuemax": this.#model.length.toFixed(2),
      "aria-valuetext": `${formatNumber(secs, 2)} s`,
    });
    for (const [axis, element] of this.#readOuts.entries()) {
      const said = formatNumber(values[axis] ?? 0, this.#model.rows[axis]!.digits);
      if (element.textContent !== said) element.textContent = said;
    }
  }

  #draw(): void {
    const model = this.#model;
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!model || width === 0) return;
    const layout = layOut(width, Math.max(120, height), model.rows.length, model.length);
    this.#layout = layout;
    setAttributes(this.#root, { viewBox: `0 0 ${width} ${layout.height}`, width, height: layout.height });
    const last = layout.rows.at(-1)!;
    this.#head.querySelector("line")!.setAttribute("y2", String(last.top + last.height + 6));
    const active = document.activeElement;
    const focused = active instanceof SVGElement && this.#picture.contains(active) ? active.dataset.place : undefined;
    this.#readOuts = [];
    this.#picture.replaceChildren(
      svg("g", { class: "keys-ruler", "aria-hidden": "true" }, ...ruler(layout)),
      ...model.rows.map((row, axis) => this.#row(row, axis, model)),
    );
    if (focused) this.#picture.querySelector<SVGElement>(`[data-place="${focused}"]`)?.focus();
    this.setPlayhead(this.#secs, this.#values);
  }

  #scale(axis: number): Scale {
    return rowScale(this.#layout.rows[axis]!, this.#model!.ranges[axis]!);
  }

  #row(name: RowName, axis: number, { keys, chosen, rows, way }: TimelineModel): SVGGElement {
    const { time, rows: places, width } = this.#layout;
    const { top, height } = places[axis]!;
    const middle = top + height / 2;
    const scale = this.#scale(axis);
    const value = svg("tspan", { class: "keys-value" });
    this.#readOuts.push(value);
    const d = lineOf(way, axis, rows.length, time, scale);
    return svg(
      "g",
      {},
      svg("rect", { class: "keys-row", x: time.from, y: top, width: width - 20 - time.from, height, rx: 3 }),
      svg("text", { class: "keys-title", x: 20, y: middle - 3 }, name.title),
      svg("text", { class: "keys-read", x: 20, y: middle + 14 }, value, ` ${name.unit}`),
      svg("path", { class: "keys-ahead", d }),
      svg("path", { class: "keys-way", d, "clip-path": "url(#keys-played)" }),
      ...keys.map((key, i) => this.#diamond(key, i, axis, i === chosen, name, scale)),
    );
  }

  #diamond(key: TimedValue, i: number, axis: number, chosen: boolean, name: RowName, scale: Scale): SVGElement {
    const [x, y] = [pixelOf(this.#layout.time, key.secs), pixelOf(scale, key.values[axis]!)];
    const value = `${formatNumber(key.values[axis]!, name.digits)} ${name.unit}`.trim();
    return svg(
      "g",
      {
        class: chosen ? "keys-key chosen" : "keys-key",
        role: "slider",
        tabindex: 0,
        "data-place": `${i}-${axis}`,
        "data-key": i,
        "data-axis": axis,
        "aria-label": strings.keyStyle.keyOf(i + 1, name.title),
        "aria-orientation": "vertical",
        "aria-valuemin": this.#model!.ranges[axis]!.least.toFixed(2),
        "aria-valuemax": this.#model!.ranges[axis]!.most.toFixed(2),
        "aria-valuenow": key.values[axis]!.toFixed(2),
        "aria-valuetext": strings.keyStyle.keyAt(formatNumber(key.secs, 2), value),
        transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
      },
      svg("circle", { class: "keys-target", r: 14 }),
      svg("path", { d: "M0 -6l6 6-6 6-6-6z" }),
      svg("title", {}, strings.keyStyle.keyAt(formatNumber(key.secs, 2), value)),
    );
  }

  #onPointerDown(event: PointerEvent): void {
    if (event.button !== 0 || !this.#model || this.#drag) return;
    const target = (event.target as Element).closest<SVGElement>(".keys-key, .maker-head, .keys-seek");
    if (!target) return;
    const { x, y } = this.#place(event);
    const key = target.dataset.key === undefined ? -1 : Number(target.dataset.key);
    const axis = Number(target.dataset.axis ?? 0);
    const of = this.#model.keys[key];
    this.#drag = {
      pointerId: event.pointerId,
      key,
      axis,
      dx: of ? x - pixelOf(this.#layout.time, of.secs) : 0,
      dy: of ? y - pixelOf(this.#scale(axis), of.values[axis]!) : 0,
    };
    this.#root.setPointerCapture(event.pointerId);
    event.preventDefault();
    if (key < 0) {
      this.#head.focus({ preventScroll: true });
      this.#seekTo(x);
    } else {
      target.focus({ preventScroll: true });
      this.#listeners.onChoose(key);
    }
  }

  #onPointerMove(event: PointerEvent): void {
    const drag = this.#drag;
    if (!drag || event.pointerId !== drag.pointerId) return;
    const { x, y } = this.#place(event);
    if (drag.key < 0) {
      this.#seekTo(x);
      return;
    }
    const present = this.#listeners.keys();
    // It may have been removed in the hand, by undo or by other variables.
    if (!present[drag.key]) return;
    const secs = valueAt(this.#layout.time, x - drag.dx);
    const keys = moveKey(present, drag.key, secs, this.#model!.length);
    const value = valueAt(this.#scale(drag.axis), y - drag.dy);
    this.#edit(this.#withValue(keys, drag.key, drag.axis, value), `drag ${drag.key}`, drag.key);
  }

  #onPointerEnd(event: PointerEvent): void {
    if (event.pointerId !== this.#drag?.pointerId) return;
    this.#drag = undefined;
    this.#listeners.onSettle();
  }

  #place(event: PointerEvent): { x: number; y: number } {
    const box = this.#root.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  #seekTo(x: number): void {
    const { least, most } = this.#layout.time;
    this.#listeners.onSeek(Math.min(most, Math.max(least, valueAt(this.#layout.time, x))));
  }

  #withValue(keys: readonly TimedValue[], key: number, axis: number, value: number): TimedValue[] {
    const { least, most } = this.#model!.ranges[axis]!;
    const within = Math.min(most, Math.max(least, value));
    return withValues(keys, key, keys[key]!.values.with(axis, within));
  }

  #edit(keys: readonly TimedValue[], gesture: string | undefined, chosen: number): void {
    this.#listeners.onEdit(keys, gesture && `key-style ${gesture}`, chosen);
  }

  #onKey(event: KeyboardEvent): void {
    if (!this.#model || event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as SVGElement;
    const along = { ArrowRight: 1, ArrowLeft: -1 }[event.key] ?? 0;
    const up = { ArrowUp: 1, ArrowDown: -1 }[event.key] ?? 0;
    const { length } = this.#model;
    let handled = along !== 0 || up !== 0;
    if (target === this.#head) {
      if (handled) this.#seek(this.#secs + LEAST_GAP * (along + up));
      else if (event.key === "Home" || event.key === "End") {
        this.#seek(event.key === "Home" ? 0 : length);
        handled = true;
      }
    } else if (target.dataset.key !== undefined) {
      const [key, axis] = [Number(target.dataset.key), Number(target.dataset.axis)];
      const keys = this.#listeners.keys();
      const own = keys[key];
      if (!own) return;
      if (along !== 0) this.#edit(moveKey(keys, key, own.secs + along * LEAST_GAP, length), `time ${key}`, key);
      else if (up !== 0) {
        const { least, most } = this.#model.ranges[axis]!;
        const by = up * (event.shiftKey ? STEP.fine : STEP.coarse) * (most - least);
        this.#edit(this.#withValue(keys, key, axis, own.values[axis]! + by), `value ${key}`, key);
      } else if (event.key === "Delete" || event.key === "Backspace") {
        this.#edit(removeKey(keys, key), undefined, Math.max(0, key - 1));
        handled = true;
      } else if (event.key === "Enter" || event.key === " ") {
        this.#listeners.onChoose(key);
        handled = true;
      }
    } else return;
    if (!handled) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Several keys may be pressed before the playhead is drawn again. */
  #seek(secs: number): void {
    this.#secs = Math.min(this.#model!.length, Math.max(0, secs));
    this.#listeners.onSeek(this.#secs);
  }
}
