/** The timeline of keys: a row for every style variable, keys that can be dragged in time and in value, and the playhead. */

import { formatNumber, html, setText, svg } from "../../../ui/dom";
import { type Drag, listenToDrags } from "../../../ui/drag";
import { placeIn, setSize, sizeOf } from "../../../ui/drawing";
import { clampedValueAt, type Extent, pixelOf, type Scale, valueAt } from "../../../ui/scale";
import type { TimedValue } from "../../state/key_style";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { onResize } from "../../ui/resize";
import { Playhead } from "../synthesis/playhead";
import type { KeyEditor } from "./key_editor";
import { MIN_GAP, moveKey, removeKey, withValues } from "./keys";
import { type Layout, layOut, lineOf, type RowName, RULER_Y, rowGround, rowScale, rulerOf } from "./timeline_rows";

/** Step of an arrow key as a share of the range; the fine one with Shift. */
const STEP = { coarse: 0.02, fine: 0.004 };

interface TimelineModel {
  rows: readonly RowName[];
  ranges: readonly Extent[];
  keys: readonly TimedValue[];
  chosen: number;
  /** Length, seconds. */
  length: number;
  /** The curve through the keys: all variables at equally spaced times over the whole length, time after time. */
  curve: Float32Array;
}

export class Timeline {
  readonly element = html("div", { class: "keys" });
  readonly #store: Store;
  readonly #editor: KeyEditor;
  readonly #onSeek: (secs: number) => void;
  readonly #root = svg("svg", { class: "keys-plot", role: "group", "aria-label": strings.keyStyle.timeline });
  readonly #picture = svg("g");
  /** The part before the playhead. */
  readonly #played = svg("rect", { x: 0, y: 0, height: 1000 });
  readonly #playhead: Playhead;
  #model: TimelineModel | undefined;
  #layout: Layout = layOut(600, 184, 1, 1);
  #secs = 0;
  #values: readonly number[] = [];
  #readOuts: SVGElement[] = [];

  constructor(store: Store, editor: KeyEditor, onSeek: (secs: number) => void) {
    this.#store = store;
    this.#editor = editor;
    this.#onSeek = onSeek;
    this.#playhead = new Playhead({
      label: strings.synthesis.time,
      rulerY: RULER_Y,
      step: MIN_GAP,
      onSeek,
    });
    const clip = svg("clipPath", { id: "keys-played" }, this.#played);
    this.#root.append(svg("defs", {}, clip), this.#picture, this.#playhead.element);
    this.element.append(this.#root);
    listenToDrags(this.#root, (press) => this.#begin(press));
    this.#root.addEventListener("keydown", (event) => this.#onKey(event));
    this.#root.addEventListener("keyup", store.gestureListeners.onSettle);
  }

  /** Follows the size of the page until `signal` aborts. */
  attach(signal: AbortSignal): void {
    onResize(this.element, () => this.#draw(), signal);
  }

  show(model: TimelineModel): void {
    this.#model = model;
    this.#draw();
  }

  /** Moves the playhead to a time, at which the variables have these values. */
  setPlayhead(secs: number, values: readonly number[]): void {
    this.#secs = secs;
    this.#values = values;
    if (!this.#model) return;
    const { length, rows } = this.#model;
    const x = pixelOf(this.#layout.time, secs);
    this.#playhead.place({ value: secs, max: length, x, text: `${formatNumber(secs, 2)} s` });
    this.#played.setAttribute("width", Math.max(0, x).toFixed(1));
    for (const [axis, element] of this.#readOuts.entries())
      setText(element, formatNumber(values[axis] ?? 0, rows[axis]!.digits));
  }

  #draw(): void {
    const model = this.#model;
    const { width, height } = sizeOf(this.element);
    if (!model || width === 0) return;
    const layout = layOut(width, height, model.rows.length, model.length);
    this.#layout = layout;
    setSize(this.#root, layout);
    this.#playhead.bottom = layout.bottom;
    const active = document.activeElement;
    const focused = active instanceof SVGElement && this.#picture.contains(active) ? active.dataset.place : undefined;
    this.#readOuts = [];
    this.#picture.replaceChildren(rulerOf(layout), ...model.rows.map((row, axis) => this.#row(row, axis, model)));
    if (focused) this.#picture.querySelector<SVGElement>(`[data-place="${focused}"]`)?.focus();
    this.setPlayhead(this.#secs, this.#values);
  }

  #scale(axis: number): Scale {
    return rowScale(this.#layout.rows[axis]!, this.#model!.ranges[axis]!);
  }

  #row(name: RowName, axis: number, { keys, chosen, rows, curve }: TimelineModel): SVGGElement {
    const layout = this.#layout;
    const scale = this.#scale(axis);
    const value = svg("tspan", { class: "keys-value" });
    this.#readOuts.push(value);
    const d = lineOf(curve, axis, rows.length, layout.time, scale);
    return svg(
      "g",
      {},
      ...rowGround(layout, layout.rows[axis]!, name.title, value, ` ${name.unit}`),
      svg("path", { class: "keys-ahead", d }),
      svg("path", { class: "keys-way", d, "clip-path": "url(#keys-played)" }),
      ...keys.map((key, i) => this.#diamond(key, i, axis, i === chosen, name, scale)),
    );
  }

  #diamond(key: TimedValue, i: number, axis: number, chosen: boolean, name: RowName, scale: Scale): SVGElement {
    const value = key.values[axis]!;
    const [x, y] = [pixelOf(this.#layout.time, key.secs), pixelOf(scale, value)];
    const read = `${formatNumber(value, name.digits)} ${name.unit}`.trim();
    const text = strings.keyStyle.keyAt(formatNumber(key.secs, 2), read);
    const { min, max } = this.#model!.ranges[axis]!;
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
        "aria-valuemin": min.toFixed(2),
        "aria-valuemax": max.toFixed(2),
        "aria-valuenow": value.toFixed(2),
        "aria-valuetext": text,
        transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
      },
      // A tooltip of the slider itself would be announced after its value, which is the same.
      svg(
        "g",
        { "aria-hidden": "true" },
        svg("title", {}, text),
        svg("circle", { class: "keys-target", r: 14 }),
        svg("path", { d: "M0 -6l6 6-6 6-6-6z" }),
      ),
    );
  }

  #begin(press: PointerEvent): Drag | undefined {
    if (!this.#model) return undefined;
    const target = (press.target as Element).closest<SVGElement>(".keys-key, .editor-head, .timeline-seek");
    if (!target) return undefined;
    press.preventDefault();
    if (target.dataset.key === undefined) return this.#seeking(press);
    target.focus({ preventScroll: true });
    return this.#editing(press, Number(target.dataset.key), Number(target.dataset.axis));
  }

  #seeking(press: PointerEvent): Drag {
    const onSeek = this.#onSeek;
    const { onSettle } = this.#store.gestureListeners;
    const before = this.#secs;
    const seekTo = (event: PointerEvent) => onSeek(clampedValueAt(this.#layout.time, placeIn(this.#root, event).x));
    this.#playhead.focus();
    seekTo(press);
    return { move: seekTo, cancel: () => onSeek(before), end: onSettle };
  }

  /** A drag of a key in time, and in the value of one variable. */
  #editing(press: PointerEvent, key: number, axis: number): Drag {
    const { onSettle, onCancel } = this.#store.gestureListeners;
    const { secs, values } = this.#editor.keys[key]!;
    const { x, y } = placeIn(this.#root, press);
    const offset = {
      x: x - pixelOf(this.#layout.time, secs),
      y: y - pixelOf(this.#scale(axis), values[axis]!),
    };
    onSettle();
    this.#editor.choose(key);
    return {
      move: (event) => {
        const present = this.#editor.keys;
        // Undo or other variables may have removed it during the drag.
        if (!present[key]) return;
        const place = placeIn(this.#root, event);
        const inTime = moveKey(present, key, valueAt(this.#layout.time, place.x - offset.x), this.#model!.length);
        const value = valueAt(this.#scale(axis), place.y - offset.y);
        this.#edit(this.#withValue(inTime, key, axis, value), `drag ${key}`, key);
      },
      cancel: onCancel,
      end: onSettle,
    };
  }

  #withValue(keys: readonly TimedValue[], key: number, axis: number, value: number): TimedValue[] {
    const { min, max } = this.#model!.ranges[axis]!;
    const within = Math.min(max, Math.max(min, value));
    return withValues(keys, key, keys[key]!.values.with(axis, within));
  }

  /** Sets new keys. Edits of one `gesture`, a drag or a run of key presses, are one undo step. */
  #edit(keys: readonly TimedValue[], gesture: string, keyChosen: number): void {
    this.#store.edit({ keys, keyChosen }, `key-style ${gesture}`);
  }

  #onKey(event: KeyboardEvent): void {
    const { key, axis } = (event.target as SVGElement).dataset;
    if (!this.#model || key === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    if (!this.#press(Number(key), Number(axis), event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Edits a key by the keyboard. Returns whether the pressed key has a function here. */
  #press(key: number, axis: number, { key: pressed, shiftKey }: KeyboardEvent): boolean {
    // The displayed keys may be one display frame old.
    const { keys } = this.#editor;
    const own = keys[key];
    if (!own) return false;
    const along = { ArrowRight: 1, ArrowLeft: -1 }[pressed] ?? 0;
    const up = { ArrowUp: 1, ArrowDown: -1 }[pressed] ?? 0;
    const { ranges, length } = this.#model!;
    if (along !== 0) this.#edit(moveKey(keys, key, own.secs + along * MIN_GAP, length), `time ${key}`, key);
    else if (up !== 0) {
      const { min, max } = ranges[axis]!;
      const by = up * (shiftKey ? STEP.fine : STEP.coarse) * (max - min);
      this.#edit(this.#withValue(keys, key, axis, own.values[axis]! + by), `value ${key}`, key);
    } else if (pressed === "Delete" || pressed === "Backspace")
      this.#store.edit({ keys: removeKey(keys, key), keyChosen: Math.max(0, key - 1) });
    else if (pressed === "Enter" || pressed === " ") this.#editor.choose(key);
    else return false;
    return true;
  }
}
