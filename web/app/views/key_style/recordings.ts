/** The training motions: each style variable over time. A press moves the pad's handle to the pose recorded there. */
import type { TrainingClip } from "../../../client/models/key_style";
import { icon } from "../../../ui/controls/icons";
import { formatNumber, html, svg } from "../../../ui/dom";
import { listenToDrags } from "../../../ui/drag";
import { placeIn, setSize, sizeOf } from "../../../ui/drawing";
import { type Extent, pixelOf, valueAt } from "../../../ui/scale";
import { strings } from "../../strings/strings";
import { onResize } from "../../ui/resize";
import { spoken } from "../../ui/words";
import { Playhead } from "../synthesis/playhead";
import { type Layout, layOut, lineOf, type RowName, RULER_Y, rowGround, rowScale, rulerOf } from "./timeline_rows";

interface RecordingsModel {
  rows: readonly RowName[];
  ranges: readonly Extent[];
  clips: readonly Pick<TrainingClip, "name" | "first" | "frames">[];
  /** The variables of every training frame, frame after frame. */
  values: Float32Array;
  rateHz: number;
}

export class Recordings {
  readonly element: HTMLElement;
  readonly #onPick: (frame: number) => void;
  readonly #select = html("select", { "aria-label": strings.keyStyle.recording });
  readonly #plot = html("div", { class: "keys" });
  readonly #root = svg("svg", { class: "keys-plot recordings-plot" });
  readonly #picture = svg("g", { "aria-hidden": "true" });
  readonly #playhead: Playhead;
  #model: RecordingsModel | undefined;
  #layout: Layout = layOut(600, 184, 1, 1);
  /** Index of the displayed clip. */
  #shown = 0;
  /** The current frame, counted over all clips. */
  #frame = 0;
  #dragging = false;

  constructor(onPick: (frame: number) => void) {
    this.#onPick = onPick;
    this.#playhead = new Playhead({
      label: strings.keyStyle.recordedPose,
      rulerY: RULER_Y,
      step: 1,
      onSeek: (frame) => this.#pick(frame),
    });
    this.#root.append(this.#picture, this.#playhead.element);
    this.#plot.append(this.#root);
    this.element = html(
      "div",
      { class: "recordings" },
      html("div", { class: "select plain-select recordings-clip" }, this.#select, icon("chevron")),
      this.#plot,
    );
    this.#select.addEventListener("change", () => {
      this.#shown = Number(this.#select.value);
      this.#frame = this.#clip?.first ?? 0;
      this.#draw();
    });
    listenToDrags(this.#root, (press) => {
      if (!this.#clip) return undefined;
      const before = this.#frame;
      this.#dragging = true;
      this.#playhead.focus();
      press.preventDefault();
      this.#pickAt(press);
      return {
        move: (event) => this.#pickAt(event),
        cancel: () => this.#pick(before - (this.#clip?.first ?? 0)),
        end: () => {
          this.#dragging = false;
        },
      };
    });
  }

  /** Follows the size of the page until `signal` aborts. */
  attach(signal: AbortSignal): void {
    onResize(this.element, () => this.#draw(), signal);
  }

  show(model: RecordingsModel): void {
    this.#model = model;
    if (this.#shown >= model.clips.length) this.#shown = 0;
    this.#select.replaceChildren(...model.clips.map(({ name }, i) => html("option", { value: i }, spoken(name))));
    this.#select.value = String(this.#shown);
    this.#draw();
  }

  /** Moves the mark to a frame, counted over all clips, and shows its clip. */
  set frame(frame: number) {
    if (!this.#model || this.#dragging || frame === this.#frame) return;
    this.#frame = frame;
    const clip = this.#model.clips.findIndex(({ first, frames }) => frame >= first && frame < first + frames);
    if (clip >= 0 && clip !== this.#shown) {
      this.#shown = clip;
      this.#select.value = String(clip);
      this.#draw();
    } else this.#place();
  }

  get #clip() {
    return this.#model?.clips[this.#shown];
  }

  #draw(): void {
    const { width, height } = sizeOf(this.#plot);
    const model = this.#model;
    const clip = this.#clip;
    if (!model || !clip || width === 0) return;
    const axes = model.rows.length;
    const layout = layOut(width, height, axes, (clip.frames - 1) / model.rateHz);
    this.#layout = layout;
    setSize(this.#root, layout);
    this.#playhead.bottom = layout.bottom;
    const values = model.values.subarray(clip.first * axes, (clip.first + clip.frames) * axes);
    this.#picture.replaceChildren(
      rulerOf(layout),
      ...model.rows.flatMap(({ title, unit }, axis) => {
        const place = layout.rows[axis]!;
        const d = lineOf(values, axis, axes, layout.time, rowScale(place, model.ranges[axis]!));
        return [...rowGround(layout, place, title, unit), svg("path", { class: "keys-recorded", d })];
      }),
    );
    this.#place();
  }

  #place(): void {
    const model = this.#model;
    const clip = this.#clip;
    if (!model || !clip) return;
    const value = Math.min(clip.frames - 1, Math.max(0, this.#frame - clip.first));
    const secs = value / model.rateHz;
    const text = strings.keyStyle.recordedAt(clip.name, formatNumber(secs, 2));
    this.#playhead.place({ value, max: clip.frames - 1, x: pixelOf(this.#layout.time, secs), text });
  }

  #pickAt(event: PointerEvent): void {
    const { x } = placeIn(this.#root, event);
    this.#pick(Math.round(valueAt(this.#layout.time, x) * this.#model!.rateHz));
  }

  /** Moves the mark and the handle to a frame of the clip. */
  #pick(frame: number): void {
    const clip = this.#clip;
    if (!clip) return;
    this.#frame = clip.first + Math.min(clip.frames - 1, Math.max(0, frame));
    this.#place();
    this.#onPick(this.#frame);
  }
}
