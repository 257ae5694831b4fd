/** The states of a left and a right step with their durations; a step is lengthened by dragging its end. */
import type { JointPath } from "../../client/learn/protocol";
import type { Knob } from "../../ui/controls/knob";
import { html, setText, svg } from "../../ui/dom";
import { type Axes, ticksOf, xOf, yOf } from "../axes";
import { createKnobs } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlaneHandles } from "../plane_handles";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
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

class ChainFigure implements FigureInstance<ChainState> {
  readonly #parts: FigureParts<ChainState>;
  readonly #frame: PlotFrame;
  readonly #knobs: Record<(typeof SIDES)[number], Knob>;
  readonly #blocks = svg("g", { class: "blocks", "data-term": "d" });
  readonly #handles: PlaneHandles;
  readonly #readout = html("p", { class: "readout" });
  readonly #solving = new Latest<ChainState>((state) => this.#solve(state));
  #state: ChainState | undefined;
  #shown: Shown | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<ChainState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.chain.chain, () => this.#drawNow(), signal);
    const settle = () => change({}, true);
    this.#knobs = createKnobs(SIDES, words, words.chain.knobs, CHAIN_RANGES, CHAIN_FIELDS, change);
    const { picture } = this.#frame;
    this.#handles = new PlaneHandles(
      picture,
      SIDES.map((side) => words.chain.ends[side]),
      (fine) => (fine ? STEP.fine : STEP.coarse),
      {
        axes: () => this.#axes,
        onInput: (which, [secs]) => change({ [SIDES[which]!]: this.#rhoOf(which, secs) }, false),
        onSettle: settle,
      },
      signal,
    );
    picture.append(this.#blocks, ...this.#handles.elements);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.chain.chain)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs" }, ...SIDES.map((side) => this.#knobs[side].element)),
    );
  }

  show(state: ChainState): Promise<void> {
    this.#state = state;
    for (const side of SIDES) this.#knobs[side].value = state[side];
    return this.#solving.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureChain(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    return this.#shown ? this.#parts.words.chain.walked(...this.#read(this.#shown.path)) : "";
  }

  table(): Table {
    const { words } = this.#parts;
    const durations = this.#shown?.path.durations;
    const secs = (frames: number) => figure(frames / WALK_HZ, 3, words);
    const rows = Array.from({ length: durations ? STATES : 0 }, (_, i) => [
      words.chain.state(i + 1),
      secs(durations![i]!),
      secs(durations![STATES + i]!),
    ]);
    return { head: words.chain.durations, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#shown) return {};
    const { words } = this.#parts;
    const [left, right] = this.#read(this.#shown.path);
    const { state } = this.#shown;
    return {
      d: `${left} s, ${right} s`,
      rho: `${figure(state.left, 2, words)}, ${figure(state.right, 2, words)}`,
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    for (const side of SIDES) this.#knobs[side].element.classList.toggle("lit", term === "rho");
  }

  #read(path: JointPath): [left: string, right: string, cadence: string] {
    const { words } = this.#parts;
    const [left, right] = framesOf(path).map((frames) => figure(frames / WALK_HZ, 2, words)) as [string, string];
    return [left, right, figure(cadenceOf(path), 1, words)];
  }

  /** The ρ with which a step takes `secs` seconds. */
  #rhoOf(which: number, secs: number): number {
    const { means, variances } = this.#shown!;
    const { min, max, digits } = CHAIN_RANGES[SIDES[which]!];
    const rho = (secs * WALK_HZ - means[which]!) / variances[which]!;
    return Number(Math.min(max, Math.max(min, rho)).toFixed(digits));
  }

  async #solve(state: ChainState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [path, zero, one] = await Promise.all([
      pathOf(engine, state),
      pathOf(engine, { ...state, left: 0, right: 0 }),
      pathOf(engine, { ...state, left: 1, right: 1 }),
    ]);
    if (signal.aborted) return;
    const means = framesOf(zero);
    this.#shown = { state, path, means, variances: framesOf(one).map((frames, i) => frames - means[i]!) };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#shown) return;
    const { words } = this.#parts;
    const { path } = this.#shown;
    const axes: Axes = { width: this.#frame.width, height: this.#frame.height, x: [0, REACH], y: [0, 1] };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 5).map((value) => [value, figure(value, 1, words)] as const);
    this.#frame.drawGrid(axes, { x: words.chain.time, y: "", columns, rows: [] }, words);
    this.#blocks.replaceChildren(
      ...SIDES.flatMap((side, step) => {
        let at = 0;
        const blocks = Array.from({ length: STATES }, (_, i) => {
          const from = at;
          at += path.durations[step * STATES + i]! / WALK_HZ;
          const [x, y] = [xOf(axes, from), yOf(axes, ROW[side] + ROW.half)];
          const height = yOf(axes, ROW[side] - ROW.half) - y;
          const width = Math.max(1, xOf(axes, at) - x - 2);
          return svg(
            "g",
            {},
            svg("rect", { x, y, width, height, rx: 3 }),
            svg("text", { x: x + width / 2, y: y + height / 2 + 4, "text-anchor": "middle" }, String(i + 1)),
          );
        });
        const name = svg("text", { class: "label", x: xOf(axes, 0), y: yOf(axes, ROW[side] + ROW.half) - 6 });
        setText(name, words.chain.steps[side]);
        return [name, ...blocks];
      }),
    );
    const ends = framesOf(path).map((frames, i) => [frames / WALK_HZ, ROW[SIDES[i]!]] as const);
    this.#handles.place(axes, ends, ([secs]) => `${figure(secs, 2, words)} s`);
    setText(this.#readout, words.chain.walked(...this.#read(path)));
  }
}
