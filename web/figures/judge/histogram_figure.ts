/** Distribution of the differences between the line's answer and the neighbours' mean. */
import { ROLES, type Role } from "../../humanoid";
import { html, keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, type Extent, ticksOf, xOf, yOf } from "../axes";
import { RATE_HZ } from "../built_in";
import { Choice } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./judge.css?inline";
import { correctionAt, framesOfCorrections, measureJudge, trialOf } from "./judge_measure";
import { JUDGE_FIELDS, type JudgeState } from "./judge_state";

/** Half the range of the axis, and the width of a bin, degrees; values beyond are counted in the outer bins. */
const REACH = 1;
const BIN = 0.1;
/** Number of corrections requested at once: the picture grows with each batch. */
const BATCH = 16;

export const HISTOGRAM: FigureKind<JudgeState> = {
  fields: JUDGE_FIELDS,
  sheet,
  create: (parts) => new HistogramFigure(parts),
};

/** Number of values in each bin; those beyond the ends are in the outer ones. */
export function countsOf(values: readonly number[]): number[] {
  const bins = Math.round((2 * REACH) / BIN) + 1;
  const counts = new Array<number>(bins).fill(0);
  // Bins are centred on multiples of their width, so that values near 0 fall into one bin.
  for (const value of values) counts[Math.min(bins - 1, Math.max(0, Math.round((value + REACH) / BIN)))]! += 1;
  return counts;
}

/** The median of the absolute values. */
export function typicalOf(values: readonly number[]): number {
  const sizes = values.map(Math.abs).sort((a, b) => a - b);
  return sizes[Math.floor((sizes.length - 1) / 2)] ?? Number.NaN;
}

class HistogramFigure implements FigureInstance<JudgeState> {
  readonly #parts: FigureParts<JudgeState>;
  readonly #frame: PlotFrame;
  readonly #joint: Choice<Role>;
  readonly #bars = svg("g", { class: "counts", "data-term": "u" });
  readonly #now = svg("path", { class: "leader", "data-term": "u" });
  readonly #label = svg("text", { class: "label y", "text-anchor": "middle" });
  readonly #readout = html("p", { class: "readout" });
  readonly #counting = new Latest<JudgeState>((state) => this.#count(state));
  readonly #looking = new Latest<JudgeState>((state) => this.#look(state));
  #state: JudgeState | undefined;
  #counted: { key: string; values: number[]; of: number } = { key: "", values: [], of: 0 };
  #instant: number | undefined;

  constructor(parts: FigureParts<JudgeState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.judge.corrections, () => this.#drawNow(), signal);
    this.#joint = new Choice(
      words.joint,
      ROLES.map((role) => [role, words.joints[role]] as const),
      (joint) => change({ joint }, true),
    );
    this.#frame.picture.append(this.#bars, this.#now, this.#label);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.judge.corrections), this.#joint.element),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  async show(state: JudgeState): Promise<void> {
    this.#state = state;
    this.#joint.value = state.joint;
    await Promise.all([this.#counting.take(state), this.#looking.take(state)]);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureJudge(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const { values, of } = this.#counted;
    if (!this.#state || values.length === 0) return "";
    const { words } = this.#parts;
    if (values.length < of) return words.judge.counting(String(values.length), String(of));
    const within = values.filter((value) => Math.abs(value) <= BIN).length;
    const joint = `${words.joints[this.#state.joint]} ${this.#state.axis}`;
    return words.judge.counted(
      joint,
      String(of),
      String(within),
      figure(BIN, 1, words),
      figure(typicalOf(values), 2, words),
    );
  }

  table(): Table {
    const { words } = this.#parts;
    const rows = countsOf(this.#counted.values).map((count, i) => [figure(i * BIN - REACH, 1, words), String(count)]);
    return { head: words.judge.binColumns, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (this.#instant === undefined) return {};
    return { u: `${figure(this.#instant, 2, this.#parts.words)}°` };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  /** The correction at the playhead. */
  async #look(state: JudgeState): Promise<void> {
    const instant = await correctionAt(this.#parts.engine, state, state.at);
    if (this.#parts.signal.aborted) return;
    this.#instant = instant;
    this.#draw();
  }

  async #count(state: JudgeState): Promise<void> {
    const { take, style, leftIn, joint, axis, pick } = state;
    const key = JSON.stringify([take, style, leftIn, joint, axis]);
    if (this.#counted.key === key) return;
    const { engine, signal } = this.#parts;
    const { errors } = await trialOf(engine, take, style, leftIn, pick);
    const frames = framesOfCorrections(errors.length);
    const values: number[] = [];
    for (let i = 0; i < frames.length; i += BATCH) {
      const batch = frames.slice(i, i + BATCH).map((frame) => correctionAt(engine, state, frame));
      values.push(...(await Promise.all(batch)));
      // A change of the degree of freedom must not wait for the rest of this one.
      if (signal.aborted || this.#state?.joint !== joint) return;
      this.#counted = { key: values.length === frames.length ? key : "", values, of: frames.length };
      this.#draw();
    }
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const { words } = this.#parts;
    const counts = countsOf(this.#counted.values);
    const edge = REACH + BIN / 2;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [-edge, edge],
      // The label is above the bars.
      y: [0, roundedUp(1.25 * Math.max(1, ...counts))],
    };
    const columns = ticksOf([-REACH, REACH], 4).map((value) => [value, this.#tick(value)] as const);
    const names = { x: words.judge.correction, y: words.judge.instants };
    this.#frame.drawGrid(axes, { ...names, columns, rows: ticksOf(axes.y, 4) }, words);
    keepCount(this.#bars, counts.length, () => svg("rect"));
    counts.forEach((count, i) => {
      const [left, right] = [-0.5, 0.5].map((side) => xOf(axes, (i + side) * BIN - REACH)) as unknown as Extent;
      setAttributes(this.#bars.children[i]!, {
        x: left + 1,
        y: yOf(axes, count),
        width: Math.max(1, right - left - 2),
        height: yOf(axes, 0) - yOf(axes, count),
      });
    });
    this.#drawInstant(axes);
    setText(this.#readout, this.sentence());
  }

  #drawInstant(axes: Axes): void {
    const instant = this.#instant;
    if (instant === undefined || !this.#state) return;
    const { words } = this.#parts;
    const x = xOf(axes, Math.min(REACH, Math.max(-REACH, instant)));
    const top = yOf(axes, axes.y[1]);
    setAttributes(this.#now, { d: `M${x} ${yOf(axes, 0)}V${top + 14}` });
    setAttributes(this.#label, { x: Math.min(axes.width - 60, Math.max(60, x)), y: top + 10 });
    setText(this.#label, `${figure(this.#state.at / RATE_HZ, 2, words)} s: ${figure(instant, 2, words)}°`);
  }

  /** The outer bins contain all values beyond. */
  #tick(value: number): string {
    const said = `${figure(value, 1, this.#parts.words)}°`;
    return value <= -REACH ? `≤ ${said}` : value >= REACH ? `≥ ${said}` : said;
  }
}

/** The smallest round number that is not below the value. */
function roundedUp(value: number): number {
  const step = value > 50 ? 20 : value > 20 ? 10 : 5;
  return Math.ceil(value / step) * step;
}
