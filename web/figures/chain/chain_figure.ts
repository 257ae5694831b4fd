/** The states of a left and a right step with their durations; a step is lengthened by dragging its end. */
import type { JointPath } from "../../client/learn/protocol";
import { rounded } from "../../ui/controls/range";
import { setText, svg } from "../../ui/dom";
import type { FigureKind, FigureParts } from "../kind";
import { PlaneHandles } from "../plane_handles";
import { PlotFigure } from "../plot_figure";
import sheet from "./chain.css?inline";
import { cadenceOf, framesOf, measureChain, pathOf, STATES, WALK_HZ } from "./chain_measure";
import { CHAIN_FIELDS, CHAIN_RANGES, type ChainState } from "./chain_state";

const SIDES = ["left", "right"] as const;
/** Heights of the rows, and half of a row. */
const ROW = { left: 0.72, right: 0.28, half: 0.13 } as const;
/** Range of the axis, seconds. */
const REACH = 1;
/** Step of an arrow key, seconds; with Shift the fine one. */
const STEP = { coarse: 0.02, fine: 0.005 };

export const CHAIN: FigureKind<ChainState> = {
  fields: CHAIN_FIELDS,
  measure: measureChain,
  sheet,
  create: (parts) => new ChainFigure(parts),
};

/** A path, and the durations of its steps with ρ 0 and ρ 1: durations are linear in ρ. */
interface Shown {
  state: ChainState;
  path: JointPath;
  means: readonly number[];
  variances: readonly number[];
}

class ChainFigure extends PlotFigure<ChainState, Shown> {
  readonly #blocks = svg("g", { class: "blocks", "data-term": "d" });
  readonly #handles: PlaneHandles;

  constructor(parts: FigureParts<ChainState>) {
    const { chain } = parts.words;
    super(parts, chain.chain);
    const { picture, element } = this.frame;
    this.#handles = new PlaneHandles(
      picture,
      SIDES.map((side) => chain.ends[side]),
      (fine) => (fine ? STEP.fine : STEP.coarse),
      {
        axes: () => this.axes,
        onInput: (which, [secs]) => this.change({ [SIDES[which]!]: this.#rhoOf(which, secs) }, false),
        onSettle: () => this.settle(),
      },
      parts.signal,
    );
    picture.append(this.#blocks, ...this.#handles.elements);
    this.lay({
      title: chain.chain,
      picture: element,
      controls: this.knobs(SIDES, chain.knobs, CHAIN_RANGES, { left: "rho", right: "rho" }),
    });
  }

  protected async load(state: ChainState): Promise<Shown> {
    const { engine } = this.parts;
    const [path, zero, one] = await Promise.all([
      pathOf(engine, state),
      pathOf(engine, { ...state, left: 0, right: 0 }),
      pathOf(engine, { ...state, left: 1, right: 1 }),
    ]);
    const means = framesOf(zero);
    return { state, path, means, variances: framesOf(one).map((frames, i) => frames - means[i]!) };
  }

  protected describe({ path }: Shown): string {
    return this.words.chain.walked(...this.#read(path));
  }

  protected get columns() {
    return this.words.chain.durations;
  }

  protected rows({ path: { durations } }: Shown): string[][] {
    const secs = (i: number) => this.number(durations[i]! / WALK_HZ, 3);
    return Array.from({ length: STATES }, (_, i) => [this.words.chain.state(i + 1), secs(i), secs(STATES + i)]);
  }

  protected override quantities({ path, state }: Shown) {
    const [left, right] = this.#read(path);
    return { d: `${left} s, ${right} s`, rho: `${this.number(state.left, 2)}, ${this.number(state.right, 2)}` };
  }

  #read(path: JointPath): [left: string, right: string, cadence: string] {
    const [left, right] = framesOf(path).map((frames) => this.number(frames / WALK_HZ, 2)) as [string, string];
    return [left, right, this.number(cadenceOf(path), 1)];
  }

  /** The ρ with which a step takes `secs` seconds. */
  #rhoOf(which: number, secs: number): number {
    const { means, variances } = this.shown!;
    return rounded((secs * WALK_HZ - means[which]!) / variances[which]!, CHAIN_RANGES[SIDES[which]!]);
  }

  protected draw({ path }: Shown): void {
    const labels = { x: this.words.chain.time, y: "", columns: 5, digits: 1, rows: 0 };
    const axes = this.plot({ min: 0, max: REACH }, { min: 0, max: 1 }, labels);
    this.#blocks.replaceChildren(
      ...SIDES.flatMap((side, step) => {
        let at = 0;
        const blocks = Array.from({ length: STATES }, (_, i) => {
          const from = at;
          at += path.durations[step * STATES + i]! / WALK_HZ;
          const [x, y] = [axes.x(from), axes.y(ROW[side] + ROW.half)];
          const height = axes.y(ROW[side] - ROW.half) - y;
          const width = Math.max(1, axes.x(at) - x - 2);
          return svg(
            "g",
            {},
            svg("rect", { x, y, width, height, rx: 3 }),
            svg("text", { x: x + width / 2, y: y + height / 2 + 4, "text-anchor": "middle" }, String(i + 1)),
          );
        });
        const name = svg("text", { class: "label", x: axes.x(0), y: axes.y(ROW[side] + ROW.half) - 6 });
        setText(name, this.words.chain.steps[side]);
        return [name, ...blocks];
      }),
    );
    const ends = framesOf(path).map((frames, i) => [frames / WALK_HZ, ROW[SIDES[i]!]] as const);
    this.#handles.place(axes, ends, ([secs]) => `${this.number(secs, 2)} s`);
    setText(this.readout, this.words.chain.walked(...this.#read(path)));
  }
}
