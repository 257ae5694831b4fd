/** The training motions: what each style variable measures over time, and a click that puts the handle there. */

import { icon } from "../controls/icons";
import { formatNumber, html, setAttributes, svg } from "../dom";
import { strings } from "../strings/strings";
import { spoken } from "../words";
import { pixelOf, valueAt } from "./scale";
import type { RowName } from "./timeline";
import { type Layout, layOut, lineOf, rowScale, ruler } from "./timeline_rows";

/** A clip among the training motions. */
export interface RecordedClip {
  name: string;
  /** Its first frame among all, and how many there are. */
  first: number;
  frames: number;
}

export interface RecordingsModel {
  rows: readonly RowName[];
  ranges: readonly { least: number; most: number }[];
  clips: readonly RecordedClip[];
  /** The variables of every training frame, all of a frame behind each other. */
  values: Float32Array;
  rateHz: number;
}

export class Recordings {
  readonly element: HTMLElement;
  readonly #onPick: (frame: number) => void;
  readonly #clip = html("select", { "aria-label": strings.keyStyle.recording });
  readonly #plot = html("div", { class: "keys" });
  readonly #root = svg("svg", { class: "keys-plot recordings-plot" });
  readonly #picture = svg("g", { "aria-hidden": "true" });
  readonly #head = svg(
    "g",
    {
      class: "maker-head",
      role: "slider",
      tabindex: 0,
      "aria-label": strings.keyStyle.recordedPose,
      "aria-valuemin": 0,
    },
    svg("line", { y1: 24 }),
    svg("path", { d: "M-6 22h12v8l-6 6-6-6z" }),
  );
  #model: RecordingsModel | undefined;
  #layout: Layout = layOut(600, 184, 1, 1);
  /** Number of the clip that is shown, and of the frame that stands, among all. */
  #shown = 0;
  #frame = 0;
  #dragging = false;

  constructor(onPick: (frame: number) => void) {
    this.#onPick = onPick;
    this.#root.append(this.#picture, this.#head);
    this.#plot.append(this.#root);
    this.element = html(
      "div",
      { class: "recordings" },
      html("div", { class: "select plain-select recordings-clip" }, this.#clip, icon("chevron")),
      this.#plot,
    );
    this.#clip.addEventListener("change", () => {
      this.#shown = Number(this.#clip.value);
      this.#frame = this.#model?.clips[this.#shown]?.first ?? 0;
      this.#draw();
    });
    this.#root.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.#dragging = true;
      this.#root.setPointerCapture(event.pointerId);
      this.#head.focus({ preventScroll: true });
      event.preventDefault();
      this.#pick(event);
    });
    this.#root.addEventListener("pointermove", (event) => this.#dragging && this.#pick(event));
    for (const type of ["pointerup", "pointercancel"] as const)
      this.#root.addEventListener(type, () => {
        this.#dragging = false;
      });
    this.#head.addEventListener("keydown", (event) => this.#onKey(event));
    new ResizeObserver(() => this.#draw()).observe(this.element);
  }

  show(model: RecordingsModel): void {
    this.#model = model;
    if (this.#shown >= model.clips.length) this.#shown = 0;
    this.#clip.replaceChildren(...model.clips.map(({ name }, i) => html("option", { value: i }, spoken(name))));
    this.#clip.value = String(this.#shown);
    this.#draw();
  }

  /** Puts the mark at a frame, and shows its clip. */
  set frame(frame: number) {
    if (!this.#model || this.#dragging || frame === this.#frame) return;
    this.#frame = frame;
    const clip = this.#model.clips.findIndex(({ first, frames }) => frame >= first && frame < first + frames);
    if (clip >= 0 && clip !== this.#shown) {
      this.#shown = clip;
      this.#clip.value = String(clip);
      this.#draw();
    } else this.#place();
  }

  #draw(): void {
    const { clientWidth: width, clientHeight: height } = this.#plot;
    const model = this.#model;
    const clip = model?.clips[this.#shown];
    if (!model || !clip || width === 0) return;
    const layout = layOut(width, Math.max(120, height), model.rows.length, (clip.frames - 1) / model.rateHz);
    this.#layout = layout;
    setAttributes(this.#root, { viewBox: `0 0 ${width} ${layout.height}`, width, height: layout.height });
    const last = layout.rows.at(-1)!;
    this.#head.querySelector("line")!.setAttribute("y2", String(last.top + last.height + 6));
    const axes = model.rows.length;
    const values = model.values.subarray(clip.first * axes, (clip.first + clip.frames) * axes);
    this.#picture.replaceChildren(
      svg("g", { class: "keys-ruler" }, ...ruler(layout)),
      ...model.rows.flatMap(({ title, unit }, axis) => {
        const place = layout.rows[axis]!;
        const middle = place.top + place.height / 2;
        const { time } = layout;
        const row = { class: "keys-row", x: time.from, y: place.top, height: place.height, rx: 3 };
        return [
          svg("rect", { ...row, width: width - 20 - time.from }),
          svg("text", { class: "keys-title", x: 20, y: middle - 3 }, title),
          svg("text", { class: "keys-read", x: 20, y: middle + 14 }, unit),
          svg("path", {
            class: "keys-recorded",
            d: lineOf(values, axis, axes, time, rowScale(place, model.ranges[axis]!)),
          }),
        ];
      }),
    );
    this.#place();
  }

  #place(): void {
    const model = this.#model;
    const clip = model?.clips[this.#shown];
    if (!model || !clip) return;
    const frame = Math.min(clip.frames - 1, Math.max(0, this.#frame - clip.first));
    const secs = frame / model.rateHz;
    this.#head.setAttribute("transform", `translate(${pixelOf(this.#layout.time, secs).toFixed(1)} 0)`);
    setAttributes(this.#head, {
      "aria-valuemax": clip.frames - 1,
      "aria-valuenow": frame,
      "aria-valuetext": strings.keyStyle.recordedAt(clip.name, formatNumber(secs, 2)),
    });
  }

  #pick(event: PointerEvent): void {
    const model = this.#model;
    const clip = model?.clips[this.#shown];
    if (!model || !clip) return;
    const x = event.clientX - this.#root.getBoundingClientRect().left;
    this.#go(clip.first + Math.round(valueAt(this.#layout.time, x) * model.rateHz));
  }

  #go(frame: number): void {
    const clip = this.#model!.clips[this.#shown]!;
    this.#frame = Math.min(clip.first + clip.frames - 1, Math.max(clip.first, frame));
    this.#place();
    this.#onPick(this.#frame);
  }

  #onKey(event: KeyboardEvent): void {
    const clip = this.#model?.clips[this.#shown];
    if (!clip || event.ctrlKey || event.metaKey || event.altKey) return;
    const to = {
      ArrowRight: this.#frame + 1,
      ArrowUp: this.#frame + 1,
      ArrowLeft: this.#frame - 1,
      ArrowDown: this.#frame - 1,
      Home: clip.first,
      End: clip.first + clip.frames - 1,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.#go(to);
  }
}
