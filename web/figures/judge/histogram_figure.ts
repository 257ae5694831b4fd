/** Distribution of the differences between the line's answer and the neighbours' mean. */
import { ROLES } from "../../humanoid";
import { keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { LatestOnly } from "../../ui/latest_only";
import { ticks } from "../../ui/scale";
import type { Axes } from "../axes";
import { RATE_HZ } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
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
  measure: measureJudge,
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

/** The corrections so far, of a number in all. */
interface Counted {
  key: string;
  values: number[];
  of: number;
}

class HistogramFigure extends PlotFigure<JudgeState, Counted> {
  readonly #bars = svg("g", { class: "counts", "data-term": "u" });
  readonly #now = svg("path", { class: "leader", "data-term": "u" });
  readonly #label = svg("text", { class: "label y", "text-anchor": "middle" });
  readonly #looking = new LatestOnly<JudgeState>((state) => this.#look(state));
  protected override readonly drawsAhead = true;
  protected override shown: Counted | undefined = { key: "", values: [], of: 0 };
  /** The correction at the playhead. */
  #instant: number | undefined;

  constructor(parts: FigureParts<JudgeState>) {
    const { judge, joint, joints } = parts.words;
    super(parts, judge.corrections);
    this.frame.picture.append(this.#bars, this.#now, this.#label);
    this.lay({
      title: judge.corrections,
      picture: this.frame.element,
      head: [this.choice("joint", joint, ROLES, (role) => joints[role])],
    });
  }

  override async show(state: JudgeState): Promise<void> {
    await Promise.all([super.show(state), this.#looking.take(state)]);
  }

  protected async load(state: JudgeState): Promise<Counted | undefined> {
    const { take, style, leftIn, joint, axis, pick } = state;
    const key = JSON.stringify([take, style, leftIn, joint, axis]);
    if (this.shown?.key === key) return this.shown;
    const { engine, signal } = this.parts;
    const { errors } = await trialOf(engine, take, style, leftIn, pick);
    const frames = framesOfCorrections(errors.length);
    const values: number[] = [];
    for (let i = 0; i < frames.length; i += BATCH) {
      const batch = frames.slice(i, i + BATCH).map((frame) => correctionAt(engine, state, frame));
      values.push(...(await Promise.all(batch)));
      // A change of the degree of freedom must not wait for the rest of this one.
      if (signal.aborted || this.state?.joint !== joint) break;
      this.shown = { key: values.length === frames.length ? key : "", values, of: frames.length };
      this.redraw();
    }
    return this.shown;
  }

  protected describe({ values, of }: Counted, state: JudgeState): string {
    const { judge, joints } = this.words;
    if (values.length === 0) return "";
    if (values.length < of) return judge.counting(String(values.length), String(of));
    const within = values.filter((value) => Math.abs(value) <= BIN).length;
    return judge.counted(
      `${joints[state.joint]} ${state.axis}`,
      String(of),
      String(within),
      this.number(BIN, 1),
      this.number(typicalOf(values), 2),
    );
  }

  protected get columns() {
    return this.words.judge.binColumns;
  }

  protected rows({ values }: Counted): string[][] {
    return countsOf(values).map((count, i) => [this.number(i * BIN - REACH, 1), String(count)]);
  }

  protected override quantities(): Readonly<Record<string, string>> {
    return this.#instant === undefined ? {} : { u: `${this.number(this.#instant, 2)}°` };
  }

  async #look(state: JudgeState): Promise<void> {
    const instant = await correctionAt(this.parts.engine, state, state.at);
    if (this.parts.signal.aborted) return;
    this.#instant = instant;
    this.redraw();
  }

  protected draw({ values }: Counted, state: JudgeState): void {
    const counts = countsOf(values);
    const edge = REACH + BIN / 2;
    const { judge } = this.words;
    const columns = ticks({ min: -REACH, max: REACH }, 4).values.map((value) => [value, this.#tick(value)] as const);
    // The label is above the bars.
    const up = { min: 0, max: roundedUp(1.25 * Math.max(1, ...counts)) };
    const labels = { x: judge.correction, y: judge.instants, columns, rows: 4 };
    const axes = this.plot({ min: -edge, max: edge }, up, labels);
    keepCount(this.#bars, counts.length, () => svg("rect"));
    counts.forEach((count, i) => {
      const [left, right] = [axes.x((i - 0.5) * BIN - REACH), axes.x((i + 0.5) * BIN - REACH)];
      setAttributes(this.#bars.children[i]!, {
        x: left + 1,
        y: axes.y(count),
        width: Math.max(1, right - left - 2),
        height: axes.y(0) - axes.y(count),
      });
    });
    this.#drawInstant(axes, state);
    setText(this.readout, this.sentence());
  }

  #drawInstant(axes: Axes, { at }: JudgeState): void {
    const instant = this.#instant;
    if (instant === undefined) return;
    const x = axes.x(Math.min(REACH, Math.max(-REACH, instant)));
    const { top } = axes;
    setAttributes(this.#now, { d: `M${x} ${axes.y(0)}V${top + 14}` });
    setAttributes(this.#label, { x: Math.min(axes.width - 60, Math.max(60, x)), y: top + 10 });
    setText(this.#label, `${this.number(at / RATE_HZ, 2)} s: ${this.number(instant, 2)}°`);
  }

  /** The outer bins contain all values beyond. */
  #tick(value: number): string {
    const said = `${this.number(value, 1)}°`;
    return value <= -REACH ? `≤ ${said}` : value >= REACH ? `≥ ${said}` : said;
  }
}

/** The smallest round number that is not below the value. */
function roundedUp(value: number): number {
  const step = value > 50 ? 20 : value > 20 ? 10 : 5;
  return Math.ceil(value / step) * step;
}
