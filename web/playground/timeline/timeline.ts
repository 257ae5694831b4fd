/** The timeline: ruler, contacts, a joint's curve and the timing, with one playhead that can be dragged. */
import type { Analysis, CurveSubject, DatabaseInfo, Examples, FrameRange, InputInfo } from "../../worker/protocol";
import { type Colours, readColours } from "../colours";
import { formatNumber, html, setAttributes } from "../dom";
import { strings } from "../strings/strings";
import { capitalised, spoken } from "../words";
import {
  CURVE_GROUPS,
  CURVES,
  curveOf,
  plantedStretches,
  readStretches,
  spanOf,
  subjectOf,
  timingMap,
  unitOf,
} from "./curves";
import { exampleCurves } from "./examples";
import { Axis, describeBand, paintMoving, paintStill, prepare, ROWS, type TimelineData } from "./paint";

/** Least span of the curve row, degrees: a still joint stays a flat line. */
const LEAST_SPAN = 20;
/** Input time between two lines of the timing map. */
const MAP_SECS = 0.1;
/** Pixels that a press in the ruler moves before it selects a range, and around the playhead, which is dragged there. */
const SELECT_PX = 4;
const FLAG_PX = 9;

export interface TimelineListeners {
  /** The playhead was put at an input frame. */
  onScrub: (frame: number) => void;
  onScrubEnd: () => void;
  /** The pointer is over an input frame, or has left. */
  onHover: (frame: number | undefined) => void;
  onRange: (range: FrameRange | undefined) => void;
  onCurve: (name: string) => void;
}

export class Timeline {
  readonly element: HTMLElement;
  readonly #listeners: TimelineListeners;
  readonly #still = html("canvas", { class: "timeline-layer" });
  readonly #moving = html("canvas", { class: "timeline-layer" });
  readonly #rows: HTMLElement;
  readonly #menu: HTMLSelectElement;
  #input: InputInfo | undefined;
  #analysis: Analysis | undefined;
  #examples: Examples | undefined;
  #curve = "knee L";
  #data: TimelineData | undefined;
  #axis = new Axis(0, 0, 0);
  #colours: Colours | undefined;
  #frame = 0;

  #hover: number | undefined;
  #range: FrameRange | undefined;
  #classes: DatabaseInfo["classes"] = [];

  /** `keys` stands over the rows: the keys of the style track. */
  constructor(listeners: TimelineListeners, keys: HTMLElement) {
    this.#listeners = listeners;
    this.#menu = html("select", { "aria-label": strings.play.timeline.curve });
    for (const { title, names } of CURVE_GROUPS)
      this.#menu.append(
        html(
          "optgroup",
          { label: title },
          ...names.map((name) => html("option", { value: name }, strings.play.timeline.curveName(name))),
        ),
      );
    this.#menu.addEventListener("change", () => listeners.onCurve(this.#menu.value));
    this.#rows = html(
      "div",
      {
        class: "timeline-rows",
        role: "slider",
        tabindex: 0,
        "aria-label": strings.play.transport.time,
        "aria-valuemin": 0,
      },
      this.#still,
      this.#moving,
    );
    this.element = html(
      "div",
      { class: "timeline" },
      html(
        "div",
        { class: "timeline-labels" },
        html(
          "span",
          { class: "timeline-contacts", title: strings.play.timeline.contactsWhy },
          strings.play.timeline.contacts,
        ),
        html(
          "span",
          { class: "timeline-feet", "aria-hidden": "true" },
          html("i", {}, strings.play.timeline.left),
          html("i", {}, strings.play.timeline.right),
        ),
        html("span", { class: "timeline-reads", title: strings.play.timeline.readsWhy }, strings.play.timeline.reads),
        html("span", { class: "timeline-curve" }, this.#menu),
        html(
          "span",
          {
            class: "timeline-timing",
            title: strings.play.timeline.timingWhy,
          },
          strings.play.timeline.timing,
        ),
      ),
      html("div", { class: "timeline-stage" }, this.#rows, keys),
    );
    // The canvases come into being while the graphics processor, which is asked, has nothing to do yet.
    for (const canvas of [this.#still, this.#moving]) prepare(canvas, 1, 1);
    this.#listenToPointer();
    new ResizeObserver(() => this.#repaint()).observe(this.#rows);
  }

  /** Shows another input; the styled rows stay empty until its analysis comes. */
  set input(input: InputInfo) {
    this.#input = input;
    this.#analysis = undefined;
    this.#examples = undefined;
    this.#rebuild();
  }

  set analysis(analysis: Analysis) {
    // Until its own examples come the curve is shown without those of the analysis before.
    this.#examples = undefined;
    this.#analysis = analysis;
    this.#rebuild();
  }

  /** What examples of the curve would have to show; see {@link subjectOf}. */
  get subject(): CurveSubject | undefined {
    return subjectOf(CURVES[this.#curve]!);
  }

  /** The examples that the analysis came from, of the curve's {@link subject}. */
  set examples(examples: Examples | undefined) {
    this.#examples = examples;
    this.#rebuild();
    this.#describeHover();
  }

  set curve(name: string) {
    this.#curve = name in CURVES ? name : "knee L";
    this.#menu.value = this.#curve;
    if (this.#examples?.subject !== this.subject) this.#examples = undefined;
    this.#rebuild();
  }

  /** The classes that the input is read as. */
  set classes(classes: DatabaseInfo["classes"]) {
    this.#classes = classes;
  }

  /** The part of the input that is played. */
  set range(range: FrameRange | undefined) {
    this.#range = range;
    this.#paintMoving();
  }

  /** Place of an input frame in the rows, CSS pixels. */
  x(frame: number): number {
    return this.#axis.x(frame);
  }

  /** Input frame at a place of the page. */
  frameAt(clientX: number): number {
    return this.#axis.frame(clientX - this.#rows.getBoundingClientRect().left);
  }

  /** Called when frames have other places. */
  onLayout: (() => void) | undefined;

  /** Moves the playhead to an input frame. */
  set frame(frame: number) {
    this.#frame = frame;
    const { rateHz, durationSecs } = this.#input ?? { rateHz: 60, durationSecs: 0 };
    const now = frame / rateHz;
    setAttributes(this.#rows, {
      "aria-valuemax": durationSecs.toFixed(2),
      "aria-valuenow": now.toFixed(2),
      "aria-valuetext": strings.play.timeline.now(formatNumber(now, 2), formatNumber(durationSecs, 2)),
    });
    this.#paintMoving();
  }

  /** Reads the colours again after the theme changed. */
  recolour(): void {
    this.#colours = undefined;
    this.#repaint();
  }

  #rebuild(): void {
    const input = this.#input;
    if (!input) return;
    const measure = CURVES[this.#curve]!;
    const inputCurve = curveOf(input.poses, measure);
    const styledCurve = this.#analysis ? curveOf(this.#analysis.poses, measure) : new Float32Array(0);
    const examples = this.#examples && exampleCurves(this.#examples, measure, styledCurve);
    const planted = this.#analysis?.planted ?? new Uint8Array(0);
    this.#data = {
      frames: input.frames,
      rateHz: input.rateHz,
      inputCurve,
      styledCurve,
      examples,
      span: spanOf([inputCurve, styledCurve, ...(examples ? [examples.low, examples.high] : [])], LEAST_SPAN),
      planted: [plantedStretches(planted, 0), plantedStretches(planted, 1)],
      reads: this.#analysis ? readStretches(this.#analysis.classWeights, this.#classes.length) : [],
      timing: this.#analysis ? timingMap(this.#analysis.timeOut, Math.round(MAP_SECS * input.rateHz)) : [],
      durationOutSecs: this.#analysis?.durationOutSecs ?? 0,
    };
    this.#repaint();
  }

  #repaint(): void {
    const { clientWidth: width, clientHeight: height } = this.#rows;
    if (!this.#data || width === 0) return;
    this.#axis = new Axis(this.#data.frames, width, height);
    this.#colours ??= readColours(this.#rows);
    paintStill(prepare(this.#still, width, height), this.#axis, this.#data, this.#colours);
    this.#paintMoving();
    this.onLayout?.();
  }

  #paintMoving(): void {
    if (!this.#data || !this.#colours || this.#axis.width === 0) return;
    const context = prepare(this.#moving, this.#axis.width, this.#axis.height);
    const overlay = {
      frame: this.#frame,
      hover: this.#hover,
      range: this.#range,
      unit: unitOf(CURVES[this.#curve]!),
    };
    paintMoving(context, this.#axis, this.#data, overlay, this.#colours);
  }

  #listenToPointer(): void {
    const rows = this.#rows;
    const listeners = this.#listeners;
    let dragging: { pointerId: number; from: number; x: number; selects: boolean } | undefined;
    rows.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || !this.#data) return;
      const box = rows.getBoundingClientRect();
      const onFlag = Math.abs(event.clientX - box.left - this.#axis.x(this.#frame)) < FLAG_PX;
      const inRuler = event.clientY - box.top < ROWS.ruler && !onFlag;
      const from = this.frameAt(event.clientX);
      dragging = { pointerId: event.pointerId, from, x: event.clientX, selects: inRuler };
      rows.setPointerCapture(event.pointerId);
      this.#hoverAt(undefined);
      listeners.onScrub(from);
    });
    rows.addEventListener("pointermove", (event) => {
      const at = this.frameAt(event.clientX);
      if (event.pointerId !== dragging?.pointerId) {
        if (event.pointerType === "mouse") this.#hoverAt(at);
      } else if (!dragging.selects) listeners.onScrub(at);
      else if (Math.abs(event.clientX - dragging.x) > SELECT_PX) listeners.onRange(rangeBetween(dragging.from, at));
    });
    rows.addEventListener("pointerleave", () => this.#hoverAt(undefined));
    rows.addEventListener("dblclick", (event) => {
      if (event.clientY - rows.getBoundingClientRect().top < ROWS.ruler) listeners.onRange(undefined);
    });
    for (const type of ["pointerup", "pointercancel"] as const)
      rows.addEventListener(type, (event) => {
        if (event.pointerId !== dragging?.pointerId) return;
        dragging = undefined;
        listeners.onScrubEnd();
      });
  }

  #hoverAt(frame: number | undefined): void {
    if (frame === undefined && this.#hover === undefined) return;
    this.#hover = frame;
    this.#listeners.onHover(frame);
    this.#describeHover();
    this.#paintMoving();
  }

  /** Says what is under the pointer. */
  #describeHover(): void {
    const frame = this.#hover;
    this.#rows.title = frame === undefined ? "" : `${this.#readAt(frame)} ${this.#examplesAt(frame)}`.trim();
  }

  /** What the engine reads the input as at a frame, in words. */
  #readAt(frame: number): string {
    const stretch = this.#data?.reads.find(({ from, to }) => frame >= from && frame < to);
    const read = stretch && this.#classes[stretch.class];
    return read ? strings.play.timeline.readAt(spoken(read.action), spoken(read.style)) : "";
  }

  /** What the examples of a frame say of the curve, in words. */
  #examplesAt(frame: number): string {
    const text = describeBand(this.#data?.examples, Math.round(frame), unitOf(CURVES[this.#curve]!));
    return text && `${capitalised(text)}.`;
  }
}

/** The range between two places, at least two frames long. */
function rangeBetween(a: number, b: number): FrameRange {
  const [first, last] = [Math.round(Math.min(a, b)), Math.round(Math.max(a, b))];
  return { first, last: Math.max(last, first + 1) };
}
