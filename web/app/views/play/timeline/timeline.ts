/** The timeline: ruler, contacts, a joint's curve and the timing, with one playhead that can be dragged. */
import "./timeline.css";
import type {
  Analysis,
  CurveSubject,
  DatabaseInfo,
  Examples,
  FrameRange,
  InputInfo,
} from "../../../../client/protocol";
import { formatNumber, html, setAttributes } from "../../../../ui/dom";
import { type Drag, listenToDrags } from "../../../../ui/drag";
import { textZoom } from "../../../../ui/media";
import { strings } from "../../../strings/strings";
import { prepareCanvas } from "../../../ui/canvas";
import { type Colours, readColours } from "../../../ui/colours";
import { capitalised, spoken } from "../../../ui/words";
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
import { Axis, describeBand, paintMoving, paintStill, ROWS, type TimelineData } from "./paint";
import { trimBetween } from "./trim";
import { TrimHandles, type TrimListeners } from "./trim_handles";

/** Minimum span of the curve row, degrees: a still joint remains a flat line. */
const MIN_SPAN = 20;
/** Input time between two lines of the timing map, seconds. */
const MAP_SECS = 0.1;
/**
 * Distance that a press in the ruler must move to select a range, and the radius around the playhead in which it is
 * dragged, pixels.
 */
const SELECT_PX = 4;
const FLAG_PX = 9;
/** In main memory: a canvas on the GPU would wait for the 3-D picture. */
const IN_MEMORY: CanvasRenderingContext2DSettings = { willReadFrequently: true };

/** Called when the playhead moves, and when the trim changes. */
export interface TimelineListeners extends TrimListeners {
  /** Called when the pointer is over an input frame, or has left. */
  onHover: (frame: number | undefined) => void;
  onCurve: (name: string) => void;
  /** Called when the atlas under the rows is to open or close. */
  onAtlas: () => void;
}

export class Timeline {
  readonly element: HTMLElement;
  readonly #listeners: TimelineListeners;
  readonly #still = html("canvas", { class: "timeline-layer" });
  readonly #moving = html("canvas", { class: "timeline-layer" });
  readonly #rows: HTMLElement;
  readonly #handles: TrimHandles;
  readonly #listening = new AbortController();
  readonly #observer = new ResizeObserver(() => this.#repaint());
  readonly #menu: HTMLSelectElement;
  readonly #atlas: HTMLButtonElement;
  #input: InputInfo | undefined;
  #analysis: Analysis | undefined;
  #examples: Examples | undefined;
  #curve = "knee L";
  #data: TimelineData | undefined;
  #axis = new Axis(0, 0, 0);
  /** CSS pixels per unit of the drawing: more than one if the user's text is larger. */
  #zoom = 1;
  #colours: Colours | undefined;
  #frame = 0;

  #hover: number | undefined;
  #range: FrameRange | undefined;
  #classes: DatabaseInfo["classes"] = [];

  /** `keys` is placed over the rows: the keys of the style track. */
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
    this.#atlas = html(
      "button",
      { type: "button", class: "timeline-atlas", title: `${strings.play.atlas.open} (A)` },
      strings.play.timeline.atlas,
    );
    this.#atlas.addEventListener("click", listeners.onAtlas);
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
    this.#handles = new TrimHandles(listeners, this);
    this.element = html(
      "div",
      { class: "timeline" },
      html(
        "div",
        { class: "timeline-labels" },
        this.#atlas,
        html(
          "span",
          { class: "timeline-contacts", "aria-hidden": "true", title: strings.play.timeline.contactsWhy },
          strings.play.timeline.contacts,
        ),
        html(
          "span",
          { class: "timeline-feet", "aria-hidden": "true" },
          html("i", {}, strings.play.timeline.left),
          html("i", {}, strings.play.timeline.right),
        ),
        html(
          "span",
          { class: "timeline-reads", "aria-hidden": "true", title: strings.play.timeline.readsWhy },
          strings.play.timeline.reads,
        ),
        html("span", { class: "timeline-curve" }, this.#menu),
        html(
          "span",
          {
            class: "timeline-timing",
            "aria-hidden": "true",
            title: strings.play.timeline.timingWhy,
          },
          strings.play.timeline.timing,
        ),
      ),
      html("div", { class: "timeline-stage" }, this.#rows, this.#handles.element, keys),
    );
    // Created now, while the GPU is idle: creating a canvas waits for it.
    for (const canvas of [this.#still, this.#moving]) prepareCanvas(canvas, 1, 1, 1, IN_MEMORY);
    this.#listenToPointer();
    this.#observer.observe(this.#rows);
  }

  /** Shows another input; the styled rows stay empty until its analysis arrives. */
  set input(input: InputInfo) {
    this.#input = input;
    this.#handles.input = input;
    this.#analysis = undefined;
    this.#examples = undefined;
    this.#rebuild();
  }

  set analysis(analysis: Analysis) {
    // Until the new examples arrive, the curve is shown without the previous ones.
    this.#examples = undefined;
    this.#analysis = analysis;
    this.#rebuild();
  }

  /** The quantity in which examples are compared; see {@link subjectOf}. */
  get subject(): CurveSubject | undefined {
    return subjectOf(CURVES[this.#curve]!);
  }

  /** The examples behind the analysis, for the curve's {@link subject}. */
  set examples(examples: Examples | undefined) {
    this.#examples = examples;
    this.#rebuild();
    this.#describeHover();
  }

  set curve(name: string) {
    this.#curve = Object.hasOwn(CURVES, name) ? name : "knee L";
    this.#menu.value = this.#curve;
    if (this.#examples?.subject !== this.subject) this.#examples = undefined;
    this.#rebuild();
  }

  /** Whether the atlas is open under the rows. */
  set atlas(open: boolean) {
    this.#atlas.setAttribute("aria-expanded", String(open));
  }

  /** The classes that can be recognised. */
  set classes(classes: DatabaseInfo["classes"]) {
    this.#classes = classes;
  }

  /** The part of the input that is played. */
  set range(range: FrameRange | undefined) {
    this.#range = range;
    this.#handles.range = range;
    this.#paintMoving();
  }

  /** X position of an input frame in the rows, CSS pixels. */
  x(frame: number): number {
    return this.#axis.x(frame) * this.#zoom;
  }

  /** Position of an input frame from the left of the rows, a length of CSS. */
  left(frame: number): string {
    return `${this.x(frame).toFixed(1)}px`;
  }

  /** Input frame at an X position in the page. */
  frameAt(clientX: number): number {
    return this.#axis.frame((clientX - this.#rows.getBoundingClientRect().left) / this.#zoom);
  }

  /** Called after the frame axis has changed. */
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

  /** Reads the colours again after a change of theme. */
  recolour(): void {
    this.#colours = undefined;
    this.#repaint();
  }

  /** Ends a drag and stops following the size of the rows. */
  dispose(): void {
    this.#listening.abort();
    this.#observer.disconnect();
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
      span: spanOf([inputCurve, styledCurve, ...(examples ? [examples.low, examples.high] : [])], MIN_SPAN),
      planted: [plantedStretches(planted, 0), plantedStretches(planted, 1)],
      reads: this.#analysis ? readStretches(this.#analysis.classWeights, this.#classes.length) : [],
      timing: this.#analysis ? timingMap(this.#analysis.timeOut, Math.round(MAP_SECS * input.rateHz)) : [],
      durationOutSecs: this.#analysis?.durationOutSecs ?? 0,
    };
    this.#repaint();
  }

  #repaint(): void {
    this.#zoom = textZoom();
    const [width, height] = [this.#rows.clientWidth / this.#zoom, this.#rows.clientHeight / this.#zoom];
    if (!this.#data || width === 0) return;
    this.#axis = new Axis(this.#data.frames, width, height);
    this.#colours ??= readColours(this.#rows);
    const still = prepareCanvas(this.#still, width, height, this.#zoom, IN_MEMORY);
    paintStill(still, this.#axis, this.#data, this.#colours);
    this.#paintMoving();
    this.#handles.layOut();
    this.onLayout?.();
  }

  #paintMoving(): void {
    if (!this.#data || !this.#colours || this.#axis.width === 0) return;
    const context = prepareCanvas(this.#moving, this.#axis.width, this.#axis.height, this.#zoom, IN_MEMORY);
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
    listenToDrags(rows, (event) => this.#beginDrag(event), this.#listening.signal);
    rows.addEventListener("pointermove", (event) => {
      const pressed = event.buttons !== 0;
      if (event.pointerType === "mouse" && !pressed) this.#hoverAt(this.frameAt(event.clientX));
    });
    rows.addEventListener("pointerleave", () => this.#hoverAt(undefined));
    rows.addEventListener("dblclick", (event) => {
      if (!this.#inRuler(event)) return;
      this.#listeners.onRange(undefined);
      this.#listeners.onSettle();
    });
  }

  /** A press moves the playhead, which follows; a press in the ruler away from the playhead begins a range. */
  #beginDrag(press: PointerEvent): Drag | undefined {
    const { frames } = this.#data ?? {};
    if (frames === undefined) return undefined;
    const listeners = this.#listeners;
    const { left } = this.#rows.getBoundingClientRect();
    const frameBefore = this.#frame;
    const onFlag = Math.abs(press.clientX - left - this.x(frameBefore)) < FLAG_PX;
    const selects = this.#inRuler(press) && !onFlag;
    const from = this.frameAt(press.clientX);
    listeners.onSettle();
    this.#hoverAt(undefined);
    listeners.onScrub(from);
    return {
      move: ({ clientX }) => {
        const at = this.frameAt(clientX);
        if (!selects) listeners.onScrub(at);
        else if (Math.abs(clientX - press.clientX) > SELECT_PX) listeners.onRange(trimBetween(from, at, frames));
      },
      cancel: () => {
        listeners.onScrub(frameBefore);
        listeners.onCancel();
      },
      end: () => {
        listeners.onSettle();
        listeners.onScrubEnd();
      },
    };
  }

  #inRuler({ clientY }: MouseEvent): boolean {
    return (clientY - this.#rows.getBoundingClientRect().top) / this.#zoom < ROWS.ruler;
  }

  #hoverAt(frame: number | undefined): void {
    if (frame === undefined && this.#hover === undefined) return;
    this.#hover = frame;
    this.#listeners.onHover(frame);
    this.#describeHover();
    this.#paintMoving();
  }

  /** Updates the tooltip of the frame under the pointer. */
  #describeHover(): void {
    const frame = this.#hover;
    this.#rows.title = frame === undefined ? "" : `${this.#readAt(frame)} ${this.#examplesAt(frame)}`.trim();
  }

  /** The recognised class at a frame, as text. */
  #readAt(frame: number): string {
    const stretch = this.#data?.reads.find(({ from, to }) => frame >= from && frame < to);
    const read = stretch && this.#classes[stretch.class];
    return read ? strings.play.timeline.readAt(spoken(read.action), spoken(read.style)) : "";
  }

  /** The examples' values of the curve at a frame, as text. */
  #examplesAt(frame: number): string {
    const text = describeBand(this.#data?.examples, Math.round(frame), unitOf(CURVES[this.#curve]!));
    return text && `${capitalised(text)}.`;
  }
}
