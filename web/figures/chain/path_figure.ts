/** The trajectory of one degree of freedom: the means and deviations of its states as steps, and the likeliest curve. */
import type { JointPath } from "../../client/learn/protocol";
import { DEGREES, ROLES, type Role } from "../../humanoid";
import type { Knob } from "../../ui/controls/knob";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, curvePath, extentOf, ticksOf, xOf, yOf } from "../axes";
import { Choice, createKnobs } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./chain.css?inline";
import { farthest, farthestDeviations, jerkOf, measureChain, pathOf, plainOf, WALK_HZ } from "./chain_measure";
import { CHAIN_FIELDS, CHAIN_RANGES, type ChainState, PROMISES, type Promised } from "./chain_state";

/** Minimum range of the axis, degrees. */
const LEAST_EXTENT = 20;
/** The curve's slope is drawn every `every` frames, with half length `half` frames. */
const TANGENT = { every: 4, half: 0.8 };

export const PATH: FigureKind<ChainState> = {
  fields: CHAIN_FIELDS,
  sheet,
  create: (parts) => new PathFigure(parts),
};

interface Shown {
  state: ChainState;
  path: JointPath;
  plain: JointPath;
}

class PathFigure implements FigureInstance<ChainState> {
  readonly #parts: FigureParts<ChainState>;
  readonly #frame: PlotFrame;
  readonly #joint: Choice<Role>;
  readonly #knobs: Record<Promised, Knob>;
  readonly #bands = svg("g", { class: "bands", "data-term": "sigma" });
  readonly #stairs = svg("path", { class: "stairs", "data-term": "mu" });
  readonly #own = svg("path", { class: "own-curve" });
  readonly #curve = svg("path", { class: "trajectory", "data-term": "c" });
  readonly #tangents = svg("path", { class: "tangents", "data-term": "delta" });
  readonly #readout = html("p", { class: "readout" });
  readonly #solving = new Latest<ChainState>((state) => this.#solve(state));
  #state: ChainState | undefined;
  #shown: Shown | undefined;

  constructor(parts: FigureParts<ChainState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.chain.path, () => this.#drawNow(), signal);
    this.#joint = new Choice(
      words.joint,
      ROLES.map((role) => [role, words.joints[role]] as const),
      (joint) => change({ joint }, true),
    );
    this.#knobs = createKnobs(PROMISES, words, words.chain.knobs, CHAIN_RANGES, CHAIN_FIELDS, change);
    this.#frame.picture.append(this.#bands, this.#stairs, this.#own, this.#tangents, this.#curve);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.chain.path), this.#joint.element),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs" }, ...PROMISES.map((name) => this.#knobs[name].element)),
    );
  }

  show(state: ChainState): Promise<void> {
    this.#state = state;
    this.#joint.value = state.joint;
    for (const name of PROMISES) this.#knobs[name].value = state[name];
    return this.#solving.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureChain(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#shown) return "";
    const { words } = this.#parts;
    return words.chain.said(words.joints[this.#shown.state.joint], ...this.#read(this.#shown));
  }

  table(): Table {
    const { words } = this.#parts;
    const path = this.#shown?.path;
    const degrees = (radians: number) => figure(radians * DEGREES, 1, words);
    const rows = Array.from(path?.c ?? [], (c, i) => [
      figure(i / WALK_HZ, 2, words),
      degrees(path!.mean[i]!),
      degrees(path!.deviation[i]!),
      degrees(c),
    ]);
    return { head: words.chain.columns, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#shown) return {};
    const { words } = this.#parts;
    const { state } = this.#shown;
    const [farthestDegrees, deviations, jerk] = this.#read(this.#shown);
    const factor = (value: number) => `× ${figure(value, value < 1 ? 3 : 1, words)}`;
    return {
      c: `${jerk} ×`,
      mu: `${farthestDegrees}°, ${deviations} σ`,
      sigma: factor(state.pose),
      delta: `${factor(state.velocity)}, ${factor(state.acceleration)}`,
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    this.#knobs.pose.element.classList.toggle("lit", term === "sigma");
    for (const name of ["velocity", "acceleration"] as const)
      this.#knobs[name].element.classList.toggle("lit", term === "delta");
  }

  #read({ state, path, plain }: Shown): [farthest: string, deviations: string, jerk: string] {
    const { words } = this.#parts;
    return [
      figure(farthest(path), 2, words),
      figure(farthestDeviations(path, state.pose), 2, words),
      figure(jerkOf(path) / jerkOf(plain), 2, words),
    ];
  }

  async #solve(state: ChainState): Promise<void> {
    const [path, plain] = await Promise.all([pathOf(this.#parts.engine, state), plainOf(this.#parts.engine, state)]);
    if (this.#parts.signal.aborted) return;
    this.#shown = { state, path, plain };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const shown = this.#shown;
    if (!shown) return;
    const { words } = this.#parts;
    const { state, path, plain } = shown;
    const inDegrees = (values: Float32Array) => Array.from(values, (value) => value * DEGREES);
    const [c, own, mean, deviation] = [path.c, plain.c, path.mean, plain.deviation].map(inDegrees) as [
      number[],
      number[],
      number[],
      number[],
    ];
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [0, c.length / WALK_HZ],
      y: extentOf([...c, ...own, ...mean.flatMap((m, i) => [m - deviation[i]!, m + deviation[i]!])], LEAST_EXTENT),
    };
    const columns = ticksOf(axes.x, 6).map((value) => [value, figure(value, 1, words)] as const);
    const y = words.chain.angle(words.joints[state.joint]);
    this.#frame.drawGrid(axes, { x: words.chain.time, y, columns, rows: ticksOf(axes.y, 4) }, words);
    const x = (frame: number) => xOf(axes, frame / WALK_HZ);
    const scale = Math.min(10, Math.sqrt(state.pose));
    this.#bands.replaceChildren(
      ...mean.map((m, i) => {
        const [low, high] = [yOf(axes, m - scale * deviation[i]!), yOf(axes, m + scale * deviation[i]!)];
        const [top, bottom] = [Math.max(yOf(axes, axes.y[1]), high), Math.min(yOf(axes, axes.y[0]), low)];
        return svg("rect", { x: x(i), y: top, width: x(i + 1) - x(i), height: Math.max(1, bottom - top) });
      }),
    );
    setAttributes(this.#stairs, { d: mean.map((m, i) => `M${x(i)} ${yOf(axes, m)}H${x(i + 1)}`).join("") });
    // A frame's value is drawn at its middle.
    const curve = (values: readonly number[]) =>
      curvePath({ ...axes, x: [-0.5 / WALK_HZ, (values.length - 0.5) / WALK_HZ] }, values, WALK_HZ);
    setAttributes(this.#own, { d: curve(own) });
    setAttributes(this.#curve, { d: curve(c) });
    setAttributes(this.#tangents, {
      d: tangents(
        c,
        (frame) => x(frame + 0.5),
        (value) => yOf(axes, value),
      ),
    });
    setText(this.#readout, words.chain.read(...this.#read(shown)));
  }
}

/** Slopes of a curve, Δc, at some of its frames. */
function tangents(c: readonly number[], x: (frame: number) => number, y: (value: number) => number): string {
  let path = "";
  for (let i = TANGENT.every; i < c.length - 1; i += TANGENT.every) {
    const slope = (c[i + 1]! - c[i - 1]!) / 2;
    const end = (by: number) => `${x(i + by).toFixed(1)} ${y(c[i]! + by * slope).toFixed(1)}`;
    path += `M${end(-TANGENT.half)}L${end(TANGENT.half)}`;
  }
  return path;
}
