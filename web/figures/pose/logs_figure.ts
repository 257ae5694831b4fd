/** One component of a joint's rotation over time, computed with and without its mean. */
import { DEGREES } from "../../humanoid";
import type { Knob } from "../../ui/controls/knob";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, curvePath, extentOf, ticksOf, valueOfX, xOf, yOf } from "../axes";
import { RATE_HZ } from "../built_in";
import { createKnobs } from "../controls";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./pose.css?inline";
import { degreesOfFreedom, framesOf, greatestJump, measurePose, motionOf, rawLog } from "./pose_measure";
import { POSE_FIELDS, POSE_RANGES, type PoseState } from "./pose_state";

/** Step of an arrow key, frames; with Shift one frame. */
const STEP = 5;
/** Frames between two rows of the table. */
const TABLE_STEP = 30;
/** Minimum range of the axis, degrees. */
const LEAST_EXTENT = 60;

export const LOGS: FigureKind<PoseState> = {
  fields: POSE_FIELDS,
  sheet,
  create: (parts) => new LogsFigure(parts),
};

/** Curves, degrees, and their largest jumps, radians. */
interface Curves {
  key: string;
  raw: number[];
  centred: number[];
  rawJump: number;
  jump: number;
}

class LogsFigure implements FigureInstance<PoseState> {
  readonly #parts: FigureParts<PoseState>;
  readonly #frame: PlotFrame;
  readonly #phi: Knob;
  readonly #raw = svg("path", { class: "raw", "data-term": "R" });
  readonly #centred = svg("path", { class: "centred", "data-term": "w" });
  readonly #labels = { raw: svg("text", { class: "label x" }), centred: svg("text", { class: "label y" }) };
  readonly #handle: Handle;
  readonly #readout = html("p", { class: "readout" });
  readonly #reading = new Latest<PoseState>((state) => this.#read(state));
  #state: PoseState | undefined;
  #curves: Curves | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<PoseState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.pose.title, () => this.#drawNow(), signal);
    const settle = () => change({}, true);
    this.#phi = createKnobs(["phi"], words, words.pose.knobs, POSE_RANGES, POSE_FIELDS, change).phi;
    const { picture } = this.#frame;
    this.#handle = new Handle(
      words.playhead,
      "i",
      picture,
      {
        value: () => this.#curves && this.#state?.at,
        valueOf: (x) => valueOfX(this.#axes!, x) * RATE_HZ,
        stepped: (at, direction, fine) => at + direction * (fine ? 1 : STEP),
        ends: () => [0, (this.#curves?.raw.length ?? 1) - 1],
        onInput: (at) => change({ at: Math.round(at) }, false),
        onSettle: settle,
      },
      signal,
    );
    picture.append(this.#raw, this.#centred, ...Object.values(this.#labels), this.#handle.element);
    setText(this.#labels.raw, words.pose.raw);
    setText(this.#labels.centred, words.pose.centred);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.pose.title), this.#readout),
      this.#frame.element,
      html("div", { class: "knobs" }, this.#phi.element),
    );
  }

  show(state: PoseState): Promise<void> {
    this.#state = state;
    this.#phi.value = state.phi;
    if (this.#curves) this.#draw();
    return this.#reading.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measurePose(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const [state, curves] = [this.#state, this.#curves];
    if (!state || !curves) return "";
    const { words } = this.#parts;
    const radians = (value: number) => figure(value, 2, words);
    const { rawJump, jump } = curves;
    return words.pose.plotted(words.joints[state.joint], String(state.phi), radians(rawJump), radians(jump));
  }

  table(): Table {
    const { words } = this.#parts;
    const { raw, centred } = this.#curves ?? { raw: [], centred: [] };
    const rows = Array.from({ length: Math.ceil(raw.length / TABLE_STEP) }, (_, i) => {
      const at = i * TABLE_STEP;
      return [figure(at / RATE_HZ, 1, words), figure(raw[at]!, 1, words), figure(centred[at]!, 1, words)];
    });
    return { head: words.pose.columns, rows };
  }

  values(): Readonly<Record<string, string>> {
    return {};
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  async #read(state: PoseState): Promise<void> {
    const { joint, phi, turned, heading } = state;
    const key = JSON.stringify([state.motion, joint, phi, turned, heading]);
    if (this.#curves?.key === key) return;
    const motion = await motionOf(this.#parts.engine, state.motion, turned, heading);
    if (this.#parts.signal.aborted) return;
    const frames = framesOf(motion);
    const raw = Array.from({ length: frames }, (_, i) => rawLog(motion, joint, phi, i));
    const centred = Array.from({ length: frames }, (_, i) => degreesOfFreedom(motion, joint, phi, i));
    this.#curves = {
      key,
      raw: raw.map(([x]) => x * DEGREES),
      centred: centred.map(([x]) => x * DEGREES),
      rawJump: greatestJump(frames, (i) => raw[i]!),
      jump: greatestJump(frames, (i) => centred[i]!),
    };
    this.#draw();
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const [state, curves] = [this.#state, this.#curves];
    if (!state || !curves) return;
    const { words } = this.#parts;
    const { raw, centred, rawJump, jump } = curves;
    const secs = raw.length / RATE_HZ;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [0, secs],
      y: extentOf([...raw, ...centred], LEAST_EXTENT),
    };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 6).map((value) => [value, figure(value, 0, words)] as const);
    const y = words.pose.flexion(words.joints[state.joint]);
    this.#frame.drawGrid(axes, { x: words.pose.time, y, columns, rows: ticksOf(axes.y, 4) }, words);
    setAttributes(this.#raw, { d: curvePath(axes, raw, RATE_HZ) });
    setAttributes(this.#centred, { d: curvePath(axes, centred, RATE_HZ) });
    const at = Math.min(state.at, raw.length - 1);
    const x = xOf(axes, at / RATE_HZ);
    const place = (value: number) => ({ x: x + 8, y: yOf(axes, value) - 6 });
    setAttributes(this.#labels.raw, place(raw[at]!));
    setAttributes(this.#labels.centred, place(centred[at]!));
    const text = `${figure(at / RATE_HZ, 2, words)} s`;
    this.#handle.place({ x, bottom: yOf(axes, axes.y[0]), value: at, text });
    setText(this.#readout, words.pose.jumps(figure(rawJump, 2, words), figure(jump, 2, words)));
  }
}
