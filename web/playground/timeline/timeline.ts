/** The timeline: ruler, contacts, a joint's curve and the timing, with one playhead that can be dragged. */
import type { Analysis, InputInfo } from "../../worker/protocol";
import { type Colours, readColours } from "../colours";
import { formatNumber, html, setAttributes } from "../dom";
import { CURVES, curveOf, plantedStretches, spanOf, timingTicks } from "./curves";
import { Axis, paintMoving, paintStill, prepare, ROWS, type TimelineData } from "./paint";

/** Least span of the curve row, degrees: a still joint stays a flat line. */
const LEAST_SPAN = 20;
/** Output time between two ticks of the timing row. */
const TICK_SECS = 0.1;

export interface TimelineListeners {
  /** The playhead was put at an input frame. */
  onScrub: (frame: number) => void;
  onScrubEnd: () => void;
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
  #curve = "knee L";
  #data: TimelineData | undefined;
  #axis = new Axis(0, 0);
  #colours: Colours | undefined;
  #frame = 0;

  constructor(listeners: TimelineListeners) {
    this.#listeners = listeners;
    this.#menu = html("select", { "aria-label": "Joint of the curve" });
    for (const name of Object.keys(CURVES)) this.#menu.append(html("option", { value: name }, name));
    this.#menu.addEventListener("change", () => listeners.onCurve(this.#menu.value));
    this.#rows = html(
      "div",
      { class: "timeline-rows", role: "slider", tabindex: 0, "aria-label": "Time", "aria-valuemin": 0 },
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
          { class: "timeline-contacts", title: "When each foot of the styled motion is planted" },
          "contacts",
        ),
        html("span", { class: "timeline-feet", "aria-hidden": "true" }, html("i", {}, "L"), html("i", {}, "R")),
        html("span", { class: "timeline-curve" }, this.#menu),
        html(
          "span",
          {
            class: "timeline-timing",
            title: "A tick every tenth of a second of the styled motion: dense where it takes longer than the input",
          },
          "timing",
        ),
      ),
      this.#rows,
    );
    this.#listenToPointer();
    new ResizeObserver(() => this.#repaint()).observe(this.#rows);
  }

  /** Shows another input; the styled rows stay empty until its analysis comes. */
  set input(input: InputInfo) {
    this.#input = input;
    this.#analysis = undefined;
    this.#rebuild();
  }

  set analysis(analysis: Analysis) {
    this.#analysis = analysis;
    this.#rebuild();
  }

  set curve(name: string) {
    this.#curve = name in CURVES ? name : "knee L";
    this.#menu.value = this.#curve;
    this.#rebuild();
  }

  /** Moves the playhead to an input frame. */
  set frame(frame: number) {
    this.#frame = frame;
    const { rateHz, durationSecs } = this.#input ?? { rateHz: 60, durationSecs: 0 };
    const now = frame / rateHz;
    setAttributes(this.#rows, {
      "aria-valuemax": durationSecs.toFixed(2),
      "aria-valuenow": now.toFixed(2),
      "aria-valuetext": `${formatNumber(now, 2)} of ${formatNumber(durationSecs, 2)} seconds`,
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
    const planted = this.#analysis?.planted ?? new Uint8Array(0);
    this.#data = {
      frames: input.frames,
      rateHz: input.rateHz,
      inputCurve,
      styledCurve,
      span: spanOf([inputCurve, styledCurve], LEAST_SPAN),
      planted: [plantedStretches(planted, 0), plantedStretches(planted, 1)],
      ticks: this.#analysis ? timingTicks(this.#analysis.timeOut, TICK_SECS) : [],
    };
    this.#repaint();
  }

  #repaint(): void {
    const width = this.#rows.clientWidth;
    if (!this.#data || width === 0) return;
    this.#axis = new Axis(this.#data.frames, width);
    this.#colours ??= readColours(this.#rows);
    paintStill(prepare(this.#still, width, ROWS.height), this.#axis, this.#data, this.#colours);
    this.#paintMoving();
  }

  #paintMoving(): void {
    if (!this.#data || !this.#colours || this.#axis.width === 0) return;
    const context = prepare(this.#moving, this.#axis.width, ROWS.height);
    paintMoving(context, this.#axis, this.#data, this.#frame, this.#colours);
  }

  #listenToPointer(): void {
    const rows = this.#rows;
    let dragging: number | undefined;
    const scrub = (event: PointerEvent) =>
      this.#listeners.onScrub(this.#axis.frame(event.clientX - rows.getBoundingClientRect().left));
    rows.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || !this.#data) return;
      dragging = event.pointerId;
      rows.setPointerCapture(event.pointerId);
      scrub(event);
    });
    rows.addEventListener("pointermove", (event) => {
      if (event.pointerId === dragging) scrub(event);
    });
    for (const type of ["pointerup", "pointercancel"] as const)
      rows.addEventListener(type, (event) => {
        if (event.pointerId !== dragging) return;
        dragging = undefined;
        this.#listeners.onScrubEnd();
      });
  }
}
