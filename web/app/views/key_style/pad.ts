/** The style pad: a plane of two style variables in their units, with a handle whose position determines the pose. */

import { formatNumber, html, setAttributes, svg } from "../../../ui/dom";
import { type Drag, type GestureListeners, listenToDrags } from "../../../ui/drag";
import { placeIn, setSize, sizeOf } from "../../../ui/drawing";
import type { Extent } from "../../../ui/scale";
import { clampedValueAt, pixelOf, type Scale } from "../../../ui/scale";
import type { TimedValue } from "../../state/key_style";
import { strings } from "../../strings/strings";
import { onResize } from "../../ui/resize";
import type { Grid } from "./contours";
import { PadField } from "./pad_field";
import { drawPad } from "./pad_picture";

/** Margins of the plot, units. */
const ROOM = { left: 62, right: 12, top: 34, bottom: 50 };
const NARROW_ROOM = { left: 50, right: 10, top: 28, bottom: 46 };
/** Step of an arrow key as a share of the range; the fine one with Shift. */
const STEP = { coarse: 0.02, fine: 0.004 };
/** A press within this distance of the handle or of a key grabs it, units. */
const GRAB_PX = 12;

export interface PadListeners extends GestureListeners {
  /** Called when a drag of the handle, or a run of key presses, begins. */
  onGrab: () => void;
  onMove: (x: number, y: number) => void;
  /** Called when the drag ends. */
  onDrop: () => void;
  onChooseKey: (key: number) => void;
  onMoveKey: (key: number, x: number, y: number) => void;
}

/** The axes and the data of a model. */
interface PadSubject {
  titles: readonly [x: string, y: string];
  /** Number of decimals of each axis. */
  digits: readonly [x: number, y: number];
  ranges: readonly [x: Extent, y: Extent];
  /** Recorded values, x and y alternating. */
  points: Float32Array;
  support: Grid;
  /** Centres of the components, x and y alternating. */
  centres: Float32Array;
  /** Whether there is only one variable: the vertical axis is the time of the recordings. */
  overTime: boolean;
}

/** Keys and the curve through them. */
interface PadKeys {
  keys: readonly TimedValue[];
  chosen: number;
  /** Points of the curve at equally spaced times, x and y alternating. */
  curve: Float32Array;
}

export class Pad {
  readonly element = html("div", { class: "pad" });
  readonly #listeners: PadListeners;
  readonly #root = svg("svg", { class: "pad-plot" });
  readonly #ground = svg("g");
  readonly #centres = svg("g", { "aria-hidden": "true" });
  readonly #ahead = svg("path", { class: "pad-ahead" });
  readonly #played = svg("path", { class: "pad-way" });
  readonly #trail = svg("path", { class: "pad-trail" });
  readonly #keys = svg("g", { "aria-hidden": "true" });
  readonly #cross = svg("path", { class: "pad-cross" });
  readonly #tether = svg("path", { class: "pad-tether" });
  readonly #fields: readonly [x: PadField, y: PadField];
  readonly #handle = svg(
    "g",
    { class: "pad-handle", role: "slider", tabindex: 0, "aria-label": strings.keyStyle.handle },
    svg("circle", { class: "pad-halo", r: 15 }),
    svg("circle", { class: "pad-focus", r: 13 }),
    svg("circle", { class: "pad-body", r: 8 }),
  );
  #subject: PadSubject | undefined;
  #x: Scale = { min: 0, max: 1, from: 0, to: 1 };
  #y: Scale = { min: 0, max: 1, from: 1, to: 0 };
  #at = { x: 0.5, y: 0.5 };
  #keysShown: PadKeys = { keys: [], chosen: -1, curve: new Float32Array() };
  #share = 0;
  #trailShown: readonly TimedValue[] = [];

  constructor(listeners: PadListeners) {
    this.#listeners = listeners;
    this.#fields = [new PadField((x) => this.#type(x, this.#at.y)), new PadField((y) => this.#type(this.#at.x, y))];
    const clipped = { "clip-path": "url(#pad-clip)", "aria-hidden": "true" };
    const curves = svg("g", clipped, this.#ahead, this.#played, this.#trail);
    this.#root.append(this.#ground, this.#centres, this.#cross, curves, this.#keys, this.#tether, this.#handle);
    this.element.append(this.#root, ...this.#fields.map(({ element }) => element));
    listenToDrags(this.#root, (press) => this.#begin(press));
    this.#handle.addEventListener("keydown", (event) => this.#onKey(event));
    this.#handle.addEventListener("keyup", () => listeners.onDrop());
  }

  /** Follows the size of the page until `signal` aborts. */
  attach(signal: AbortSignal): void {
    onResize(this.element, () => this.#draw(), signal);
  }

  /** Sets another model's axes and data. */
  show(subject: PadSubject): void {
    this.#subject = subject;
    this.#draw();
  }

  /** Places the handle; `reached` is the nearest point within the training data, if it differs. */
  setHandle(x: number, y: number, spoken: string, reached?: readonly [x: number, y: number]): void {
    this.#at = { x, y: this.#subject?.overTime ? 0.5 : y };
    const [px, py] = [pixelOf(this.#x, x), pixelOf(this.#y, this.#at.y)];
    this.#handle.setAttribute("transform", `translate(${px.toFixed(1)} ${py.toFixed(1)})`);
    this.#handle.classList.toggle("beyond", reached !== undefined);
    setAttributes(this.#handle, { "aria-valuetext": spoken, "aria-valuenow": formatNumber(x, 1).replace("−", "-") });
    const overTime = this.#subject?.overTime ?? false;
    this.#cross.setAttribute(
      "d",
      `M${px.toFixed(1)} ${overTime ? this.#y.to : py.toFixed(1)}V${this.#y.from}${overTime ? "" : `M${px.toFixed(1)} ${py.toFixed(1)}H${this.#x.from}`}`,
    );
    this.#tether.setAttribute(
      "d",
      reached
        ? `M${px.toFixed(1)} ${py.toFixed(1)}L${pixelOf(this.#x, reached[0]).toFixed(1)} ${pixelOf(this.#y, reached[1]).toFixed(1)}`
        : "",
    );
    const [xField, yField] = this.#fields;
    xField.show(x, px, this.#y.from + 3, "below");
    yField.show(y, this.#x.from - 3, py, "left");
  }

  setKeys(keys: PadKeys): void {
    this.#keysShown = keys;
    this.#drawKeys();
  }

  /** Share of the curve before the playhead, 0–1. */
  set played(share: number) {
    this.#share = share;
    this.#drawCurve();
  }

  set trail(trail: readonly TimedValue[]) {
    this.#trailShown = trail;
    this.#drawTrail();
  }

  /** Shows each component by its weight in the pose. */
  set weights(weights: ArrayLike<number>) {
    const circles = this.#centres.children;
    for (let i = 0; i < circles.length; i++)
      (circles[i] as SVGElement).style.setProperty("--weight-share", (weights[i] ?? 0).toFixed(3));
  }

  #draw(): void {
    const subject = this.#subject;
    const { width, height } = sizeOf(this.element);
    if (!subject || width === 0 || height === 0) return;
    const room = width < 480 ? NARROW_ROOM : ROOM;
    setSize(this.#root, { width, height });
    const [xRange, yRange] = subject.ranges;
    this.#x = { ...xRange, from: room.left, to: width - room.right };
    this.#y = { ...yRange, from: height - room.bottom, to: room.top };
    const { titles, digits, points, support, overTime } = subject;
    for (const [axis, field] of this.#fields.entries())
      field.axis = { label: titles[axis]!, range: subject.ranges[axis]!, digits: digits[axis]! };
    this.#fields[1].element.hidden = overTime;
    this.#ground.replaceChildren(...drawPad({ x: this.#x, y: this.#y, titles, points, support, overTime }));
    const centres: SVGElement[] = [];
    for (let i = 0; i < subject.centres.length && !overTime; i += 2) {
      const [cx, cy] = [pixelOf(this.#x, subject.centres[i]!), pixelOf(this.#y, subject.centres[i + 1]!)];
      centres.push(svg("circle", { class: "pad-centre", cx: cx.toFixed(1), cy: cy.toFixed(1), r: 6 }));
    }
    this.#centres.replaceChildren(...centres);
    setAttributes(this.#handle, { "aria-valuemin": xRange.min, "aria-valuemax": xRange.max });
    this.#drawKeys();
    this.#drawTrail();
    this.setHandle(this.#at.x, this.#at.y, this.#handle.getAttribute("aria-valuetext") ?? "");
  }

  #drawKeys(): void {
    const { keys, chosen } = this.#keysShown;
    if (!this.#subject || this.#subject.overTime) {
      this.#keys.replaceChildren();
      for (const path of [this.#ahead, this.#played]) path.setAttribute("d", "");
      return;
    }
    this.#keys.replaceChildren(
      ...keys.flatMap(({ values }, i) => {
        const [x, y] = [pixelOf(this.#x, values[0]!), pixelOf(this.#y, values[1]!)];
        const diamond = svg("path", {
          class: i === chosen ? "pad-key chosen" : "pad-key",
          d: `M${x.toFixed(1)} ${(y - 6.5).toFixed(1)}l6.5 6.5-6.5 6.5-6.5-6.5z`,
        });
        // In a closed curve, the key that ends as it begins has a single number.
        const again = i > 0 && values.every((value, axis) => value === keys[0]!.values[axis]);
        return again ? [diamond] : [diamond, svg("text", { x: x + 12, y: y + 4 }, String(i + 1))];
      }),
    );
    this.#drawCurve();
  }

  #drawCurve(): void {
    const { curve } = this.#keysShown;
    if (this.#subject?.overTime) return;
    const points = curve.length / 2;
    const line = (from: number, to: number) => {
      const at: string[] = [];
      for (let i = from; i <= to && i < points; i++)
        at.push(`${pixelOf(this.#x, curve[2 * i]!).toFixed(1)} ${pixelOf(this.#y, curve[2 * i + 1]!).toFixed(1)}`);
      return at.length > 1 ? `M${at.join("L")}` : "";
    };
    const now = Math.round(this.#share * (points - 1));
    this.#ahead.setAttribute("d", line(now, points - 1));
    this.#played.setAttribute("d", line(0, now));
  }

  #drawTrail(): void {
    const at = this.#trailShown.map(({ values }) => {
      const y = this.#subject?.overTime ? 0.5 : (values[1] ?? 0.5);
      return `${pixelOf(this.#x, values[0]!).toFixed(1)} ${pixelOf(this.#y, y).toFixed(1)}`;
    });
    this.#trail.setAttribute("d", at.length > 1 ? `M${at.join("L")}` : "");
  }

  #pointOf(event: PointerEvent): { x: number; y: number; px: number; py: number } {
    const { x: px, y: py } = placeIn(this.#root, event);
    return { x: clampedValueAt(this.#x, px), y: clampedValueAt(this.#y, py), px, py };
  }

  #begin(press: PointerEvent): Drag | undefined {
    if (!this.#subject) return undefined;
    const { px, py } = this.#pointOf(press);
    press.preventDefault();
    this.element.classList.add("dragging");
    const onHandle = this.#distance(this.#at.x, this.#at.y, px, py) < GRAB_PX;
    const { keys } = this.#keysShown;
    const key =
      onHandle || this.#subject.overTime
        ? -1
        : keys.findIndex(({ values }) => this.#distance(values[0]!, values[1]!, px, py) < GRAB_PX);
    return key >= 0 ? this.#dragKey(key) : this.#dragHandle(press);
  }

  #dragKey(key: number): Drag {
    const { onChooseKey, onMoveKey, onSettle, onCancel } = this.#listeners;
    onSettle();
    onChooseKey(key);
    return {
      move: (event) => {
        const { x, y } = this.#pointOf(event);
        onMoveKey(key, x, y);
      },
      cancel: onCancel,
      end: () => {
        this.element.classList.remove("dragging");
        onSettle();
      },
    };
  }

  #dragHandle(press: PointerEvent): Drag {
    const { onGrab, onMove, onDrop } = this.#listeners;
    const before = this.#at;
    const move = (event: PointerEvent) => {
      const { x, y } = this.#pointOf(event);
      onMove(x, y);
    };
    this.#handle.focus({ preventScroll: true });
    onGrab();
    move(press);
    return {
      move,
      cancel: () => onMove(before.x, before.y),
      end: () => {
        this.element.classList.remove("dragging");
        onDrop();
      },
    };
  }

  /** Moves the handle to typed values. */
  #type(x: number, y: number): void {
    const { onGrab, onMove, onDrop } = this.#listeners;
    onGrab();
    onMove(x, y);
    onDrop();
  }

  #distance(x: number, y: number, px: number, py: number): number {
    return Math.hypot(pixelOf(this.#x, x) - px, pixelOf(this.#y, y) - py);
  }

  #onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || !this.#subject) return;
    const along = { ArrowRight: 1, ArrowLeft: -1 }[event.key] ?? 0;
    const up = { ArrowUp: 1, ArrowDown: -1 }[event.key] ?? 0;
    if (along === 0 && up === 0) return;
    event.preventDefault();
    event.stopPropagation();
    if (!event.repeat) this.#listeners.onGrab();
    const share = event.shiftKey ? STEP.fine : STEP.coarse;
    const moved = ({ min, max }: Scale, value: number, by: number) =>
      Math.min(max, Math.max(min, value + by * share * (max - min)));
    this.#listeners.onMove(moved(this.#x, this.#at.x, along), moved(this.#y, this.#at.y, up));
  }
}
