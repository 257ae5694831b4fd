/** One component of a joint's rotation over time, computed with and without its mean. */
import { DEGREES } from "../../humanoid";
import { setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import { RATE_HZ } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
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
  measure: measurePose,
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

class LogsFigure extends PlotFigure<PoseState, Curves> {
  readonly #raw = svg("path", { class: "raw", "data-term": "R" });
  readonly #centred = svg("path", { class: "centred", "data-term": "w" });
  readonly #labels = { raw: svg("text", { class: "label x" }), centred: svg("text", { class: "label y" }) };
  readonly #handle = this.playhead("at", {
    step: STEP,
    rate: () => RATE_HZ,
    ends: () => [0, (this.shown?.raw.length ?? 1) - 1],
  });
  protected override readonly drawsAhead = true;

  constructor(parts: FigureParts<PoseState>) {
    const { pose } = parts.words;
    super(parts, pose.title);
    const { picture, element } = this.frame;
    picture.append(this.#raw, this.#centred, ...Object.values(this.#labels), this.#handle.element);
    setText(this.#labels.raw, pose.raw);
    setText(this.#labels.centred, pose.centred);
    this.lay({
      title: pose.title,
      picture: element,
      head: [this.readout],
      foot: [],
      controls: this.knobs(["phi"], pose.knobs, POSE_RANGES),
    });
  }

  protected async load({ motion: name, joint, phi, turned, heading }: PoseState): Promise<Curves> {
    const key = JSON.stringify([name, joint, phi, turned, heading]);
    if (this.shown?.key === key) return this.shown;
    const motion = await motionOf(this.parts.engine, name, turned, heading);
    const frames = framesOf(motion);
    const raw = Array.from({ length: frames }, (_, i) => rawLog(motion, joint, phi, i));
    const centred = Array.from({ length: frames }, (_, i) => degreesOfFreedom(motion, joint, phi, i));
    return {
      key,
      raw: raw.map(([x]) => x * DEGREES),
      centred: centred.map(([x]) => x * DEGREES),
      rawJump: greatestJump(frames, (i) => raw[i]!),
      jump: greatestJump(frames, (i) => centred[i]!),
    };
  }

  protected describe({ rawJump, jump }: Curves, { joint, phi }: PoseState): string {
    const { pose, joints } = this.words;
    return pose.plotted(joints[joint], String(phi), this.number(rawJump, 2), this.number(jump, 2));
  }

  protected get columns() {
    return this.words.pose.columns;
  }

  protected rows({ raw, centred }: Curves): string[][] {
    return Array.from({ length: Math.ceil(raw.length / TABLE_STEP) }, (_, i) => {
      const at = i * TABLE_STEP;
      return [this.number(at / RATE_HZ, 1), this.number(raw[at]!, 1), this.number(centred[at]!, 1)];
    });
  }

  protected draw({ raw, centred, rawJump, jump }: Curves, state: PoseState): void {
    const y = this.words.pose.flexion(this.words.joints[state.joint]);
    const axes = this.plot({ min: 0, max: raw.length / RATE_HZ }, roundedExtent([...raw, ...centred], LEAST_EXTENT), {
      x: this.words.pose.time,
      y,
      columns: 6,
      digits: 0,
      rows: 4,
    });
    setAttributes(this.#raw, { d: axes.curve(raw, RATE_HZ) });
    setAttributes(this.#centred, { d: axes.curve(centred, RATE_HZ) });
    const at = Math.min(state.at, raw.length - 1);
    const x = axes.x(at / RATE_HZ);
    const place = (value: number) => ({ x: x + 8, y: axes.y(value) - 6 });
    setAttributes(this.#labels.raw, place(raw[at]!));
    setAttributes(this.#labels.centred, place(centred[at]!));
    const text = `${this.number(at / RATE_HZ, 2)} s`;
    this.#handle.place({ x, bottom: axes.bottom, value: at, text });
    setText(this.readout, this.words.pose.jumps(this.number(rawJump, 2), this.number(jump, 2)));
  }
}
