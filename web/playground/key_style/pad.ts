/** The style pad: a plane of two style variables in their own units, and a handle that gives every point of it a pose. */
import { formatNumber, html, setAttributes, svg } from "../dom";
import { strings } from "../strings/strings";
import type { Grid } from "./contours";
import type { TimedValue } from "./keys";
import { drawPad } from "./pad_picture";
import { pixelOf, type Scale, valueAt } from "./scale";

/** Room around the plot, pixels. */
const ROOM = { left: 62, right: 12, top: 34, bottom: 50 };
const NARROW_ROOM = { left: 50, right: 10, top: 28, bottom: 46 };
/** Arrow keys go this share of the range; with Shift finely. */
const STEP = { coarse: 0.02, fine: 0.004 };
/** A key this near is taken instead of the handle, pixels. */
const KEY_PX = 12;

export interface PadListeners {
  /** A hand takes the handle, … */
  onGrab: () => void;
  /** … brings it somewhere, … */
  onMove: (x: number, y: number) => void;
  /** … and lets go. */
  onDrop: () => void;
  onChooseKey: (key: number) => void;
  onMoveKey: (key: number, x: number, y: number) => void;
  onSettle: () => void;
}

/** What the pad is of. */
export interface PadSubject {
  titles: readonly [x: string, y: string];
  /** Decimals that each axis is read with. */
  digits: readonly [x: number, y: number];
  ranges: readonly [{ least: number; most: number }, { least: number; most: number }];
  /** Recorded values, x and y in turn. */
  points: Float32Array;
  support: Grid;
  /** Centres of the components, x and y in turn. */
  centres: Float32Array;
  /** Whether there is only one variable: the other axis is the recording's own time. */
  overTime: boolean;
}

/** The keys on the pad, with the way between them. */
export interface PadKeys {
  keys: readonly TimedValue[];
  chosen: number;
  /** The way, x and y in turn, and the share of it that lies behind the playhead. */
  way: Float32Array;
}

export class Pad {
  readonly element = html("div", { class: "pad" });
  readonly #listeners: PadListeners;
  readonly #root = svg("svg", { class: "pad-plot" });
  readonly #ground = svg("g");
  readonly #centres = svg("g", { "aria-hidden": "true" });
  readonly #way = [svg("path", { class: "pad-ahead" }), svg("path", { class: "pad-way" })] as const;
  readonly #trail = svg("path", { class: "pad-trail" });
  readonly #keys = svg("g", { "aria-hidden": "true" });
  readonly #cross = svg("path", { class: "pad-cross" });
  readonly #tether = svg("path", { class: "pad-tether" });
  readonly #read = [readOut(), readOut()] as const;
  readonly #handle = svg(
    "g",
    { class: "pad-handle", role: "slider", tabindex: 0, "aria-label": strings.keyStyle.handle },
    svg("circle", { class: "pad-halo", r: 15 }),
    svg("circle", { class: "pad-focus", r: 13 }),
    svg("circle", { class: "pad-body", r: 8 }),
  );
  #subject: PadSubject | undefined;
  #x: Scale = { least: 0, most: 1, from: 0, to: 1 };
  #y: Scale = { least: 0, most: 1, from: 1, to: 0 };
  #at = { x: 0.5, y: 0.5 };
  #keysShown: PadKeys = { keys: [], chosen: -1, way: new Float32Array() };
  #played = 0;
  #trailShown: readonly TimedValue[] = [];
  #drag: { pointerId: number; key: number } | undefined;

  constructor(listeners: PadListeners) {
    this.#listeners = listeners;
    const over = svg("g", { "clip-path": "url(#pad-clip)", "aria-hidden": "true" }, ...this.#way, this.#trail);
    this.#root.append(this.#ground, this.#centres, this.#cross, over, this.#keys, this.#tether, this.#handle);
    this.#root.append(...this.#read.map(({ group }) => group));
    this.element.append(this.#root);
    this.#root.addEventListener("pointerdown", (event) => this.#onPointerDown(event));
    this.#root.addEventListener("pointermove", (event) => this.#onPointerMove(event));
    for (const type of ["pointerup", "pointercancel"] as const)
      this.#root.addEventListener(type, (event) => this.#onPointerEnd(event));
    this.#handle.addEventListener("keydown", (event) => this.#onKey(event));
    this.#handle.addEventListener("keyup", () => listeners.onDrop());
    new ResizeObserver(() => this.#draw()).observe(this.element);
  }

  /** Takes another model's axes and data. */
  show(subject: PadSubject): void {
    this.#subject = subject;
    this.#draw();
  }

  /** Puts the handle somewhere; `reached` is the nearest place that the model knows, where that is another one. */
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
    const [xDigits, yDigits] = this.#subject?.digits ?? [1, 1];
    this.#read[0].say(px, this.#y.from + 15, formatNumber(x, xDigits), "middle");
    this.#read[1].say(this.#x.from - 6, py, overTime ? "" : formatNumber(y, yDigits), "end");
  }

  setKeys(keys: PadKeys): void {
    this.#keysShown = keys;
    this.#drawKeys();
  }

  /** How much of the way lies behind the playhead, 0–1. */
  set played(share: number) {
    this.#played = share;
    this.#drawWay();
  }

  set trail(trail: readonly TimedValue[]) {
    this.#trailShown = trail;
    this.#drawTrail();
  }

  /** Lights the components by how much each is of the pose. */
  set weights(weights: ArrayLike<number>) {
    const circles = this.#centres.children;
    for (let i = 0; i < circles.length; i++)
      (circles[i] as SVGElement).style.setProperty("--weight-share", (weights[i] ?? 0).toFixed(3));
  }

  #draw(): void {
    const subject = this.#subject;
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!subject || width === 0 || height === 0) return;
    const room = width < 480 ? NARROW_ROOM : ROOM;
    setAttributes(this.#root, { viewBox: `0 0 ${width} ${height}`, width, height });
    const [xRange, yRange] = subject.ranges;
    this.#x = { ...xRange, from: room.left, to: width - room.right };
    this.#y = { ...yRange, from: height - room.bottom, to: room.top };
    const { titles, points, support, overTime } = subject;
    this.#ground.replaceChildren(...drawPad({ x: this.#x, y: this.#y, titles, points, support, overTime }));
    const centres: SVGElement[] = [];
    for (let i = 0; i < subject.centres.length && !overTime; i += 2) {
      const [cx, cy] = [pixelOf(this.#x, subject.centres[i]!), pixelOf(this.#y, subject.centres[i + 1]!)];
      centres.push(svg("circle", { class: "pad-centre", cx: cx.toFixed(1), cy: cy.toFixed(1), r: 6 }));
    }
    this.#centres.replaceChildren(...centres);
    setAttributes(this.#handle, { "aria-valuemin": xRange.least, "aria-valuemax": xRange.most });
    this.#drawKeys();
    this.#drawTrail();
    this.setHandle(this.#at.x, this.#at.y, this.#handle.getAttribute("aria-valuetext") ?? "");
  }

  #drawKeys(): void {
    const { keys, chosen } = this.#keysShown;
    if (!this.#subject || this.#subject.overTime) {
      this.#keys.replaceChildren();
      for (const path of this.#way) path.setAttribute("d", "");
      return;
    }
    this.#keys.replaceChildren(
      ...keys.flatMap(({ values }, i) => {
        const [x, y] = [pixelOf(this.#x, values[0]!), pixelOf(this.#y, values[1]!)];
        const diamond = svg("path", {
          class: i === chosen ? "pad-key chosen" : "pad-key",
          d: `M${x.toFixed(1)} ${(y - 6.5).toFixed(1)}l6.5 6.5-6.5 6.5-6.5-6.5z`,
        });
        // What ends where it begins has one number there.
        const again = i > 0 && values.every((value, axis) => value === keys[0]!.values[axis]);
        return again ? [diamond] : [diamond, svg("text", { x: x + 12, y: y + 4 }, String(i + 1))];
      }),
    );
    this.#drawWay();
  }

  #drawWay(): void {
    const { way } = this.#keysShown;
    if (this.#subject?.overTime) return;
    const points = way.length / 2;
    const line = (from: number, to: number) => {
      const at: string[] = [];
      for (let i = from; i <= to && i < points; i++)
        at.push(`${pixelOf(this.#x, way[2 * i]!).toFixed(1)} ${pixelOf(this.#y, way[2 * i + 1]!).toFixed(1)}`);
      return at.length > 1 ? `M${at.join("L")}` : "";
    };
    const now = Math.round(this.#played * (points - 1));
    this.#way[0].setAttribute("d", line(now, points - 1));
    this.#way[1].setAttribute("d", line(0, now));
  }

  #drawTrail(): void {
    const at = this.#trailShown.map(({ values }) => {
      const y = this.#subject?.overTime ? 0.5 : (values[1] ?? 0.5);
      return `${pixelOf(this.#x, values[0]!).toFixed(1)} ${pixelOf(this.#y, y).toFixed(1)}`;
    });
    this.#trail.setAttribute("d", at.length > 1 ? `M${at.join("L")}` : "");
  }

  #pointOf(event: PointerEvent): { x: number; y: number; px: number; py: number } {
    const box = this.#root.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    const x = Math.min(this.#x.most, Math.max(this.#x.least, valueAt(this.#x, px)));
    const y = Math.min(this.#y.most, Math.max(this.#y.least, valueAt(this.#y, py)));
    return { x, y, px, py };
  }

  #onPointerDown(event: PointerEvent): void {
    if (event.button !== 0 || !this.#subject || this.#drag) return;
    const { x, y, px, py } = this.#pointOf(event);
    const onHandle = this.#distance(this.#at.x, this.#at.y, px, py) < KEY_PX;
    const { keys } = this.#keysShown;
    const key =
      onHandle || this.#subject.overTime
        ? -1
        : keys.findIndex(({ values }) => this.#distance(values[0]!, values[1]!, px, py) < KEY_PX);
    this.#drag = { pointerId: event.pointerId, key };
    this.#root.setPointerCapture(event.pointerId);
    event.preventDefault();
    this.element.classList.add("dragging");
    if (key >= 0) {
      this.#listeners.onChooseKey(key);
      return;
    }
    this.#handle.focus({ preventScroll: true });
    this.#listeners.onGrab();
    this.#listeners.onMove(x, y);
  }

  #onPointerMove(event: PointerEvent): void {
    if (event.pointerId !== this.#drag?.pointerId) return;
    const { x, y } = this.#pointOf(event);
    if (this.#drag.key >= 0) this.#listeners.onMoveKey(this.#drag.key, x, y);
    else this.#listeners.onMove(x, y);
  }

  #onPointerEnd(event: PointerEvent): void {
    if (event.pointerId !== this.#drag?.pointerId) return;
    const { key } = this.#drag;
    this.#drag = undefined;
    this.element.classList.remove("dragging");
    if (key >= 0) this.#listeners.onSettle();
    else this.#listeners.onDrop();
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
    const moved = ({ least, most }: Scale, value: number, by: number) =>
      Math.min(most, Math.max(least, value + by * share * (most - least)));
    this.#listeners.onMove(moved(this.#x, this.#at.x, along), moved(this.#y, this.#at.y, up));
  }
}

/** A number in a pill on an axis. */
function readOut(): { group: SVGGElement; say: (x: number, y: number, words: string, anchor: string) => void } {
  const pill = svg("rect", { height: 18, rx: 4 });
  const text = svg("text", {});
  const group = svg("g", { class: "pad-read", "aria-hidden": "true" }, pill, text);
  let [width, letters] = [0, 0];
  return {
    group,
    say: (x, y, words, anchor) => {
      group.classList.toggle("empty", words === "");
      // Figures are tabular: as many characters are as wide.
      if (words.length !== letters) {
        letters = words.length;
        width = 7 * letters + 12;
        pill.setAttribute("width", String(width));
        setAttributes(text, { x: width / 2, y: 13, "text-anchor": "middle" });
      }
      if (text.textContent !== words) text.textContent = words;
      const left = anchor === "end" ? x - width : x - width / 2;
      group.setAttribute("transform", `translate(${left.toFixed(1)} ${(y - 9).toFixed(1)})`);
    },
  };
}
