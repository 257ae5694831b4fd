/** The trajectory of one degree of freedom: the means and deviations of its states as steps, and the likeliest curve. */
import type { JointPath } from "../../client/learn/protocol";
import { DEGREES, ROLES } from "../../humanoid";
import { setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import sheet from "./chain.css?inline";
import { farthest, farthestDeviations, jerkOf, measureChain, pathOf, plainOf, WALK_HZ } from "./chain_measure";
import { CHAIN_FIELDS, CHAIN_RANGES, type ChainState, PROMISES } from "./chain_state";

/** Minimum range of the axis, degrees. */
const LEAST_EXTENT = 20;
/** The curve's slope is drawn every `every` frames, with half length `half` frames. */
const TANGENT = { every: 4, half: 0.8 };

export const PATH: FigureKind<ChainState> = {
  fields: CHAIN_FIELDS,
  measure: measureChain,
  sheet,
  create: (parts) => new PathFigure(parts),
};

interface Shown {
  state: ChainState;
  path: JointPath;
  plain: JointPath;
}

class PathFigure extends PlotFigure<ChainState, Shown> {
  readonly #bands = svg("g", { class: "bands", "data-term": "sigma" });
  readonly #stairs = svg("path", { class: "stairs", "data-term": "mu" });
  readonly #own = svg("path", { class: "own-curve" });
  readonly #curve = svg("path", { class: "trajectory", "data-term": "c" });
  readonly #tangents = svg("path", { class: "tangents", "data-term": "delta" });

  constructor(parts: FigureParts<ChainState>) {
    const { chain, joint, joints } = parts.words;
    super(parts, chain.path);
    const { picture, element } = this.frame;
    picture.append(this.#bands, this.#stairs, this.#own, this.#tangents, this.#curve);
    const terms = { pose: "sigma", velocity: "delta", acceleration: "delta" };
    this.lay({
      title: chain.path,
      picture: element,
      head: [this.choice("joint", joint, ROLES, (role) => joints[role])],
      controls: this.knobs(PROMISES, chain.knobs, CHAIN_RANGES, terms),
    });
  }

  protected async load(state: ChainState): Promise<Shown> {
    const { engine } = this.parts;
    const [path, plain] = await Promise.all([pathOf(engine, state), plainOf(engine, state)]);
    return { state, path, plain };
  }

  protected describe(shown: Shown): string {
    return this.words.chain.said(this.words.joints[shown.state.joint], ...this.#read(shown));
  }

  protected get columns() {
    return this.words.chain.columns;
  }

  protected rows({ path }: Shown): string[][] {
    const degrees = (radians: number) => this.number(radians * DEGREES, 1);
    return Array.from(path.c, (c, i) => [
      this.number(i / WALK_HZ, 2),
      degrees(path.mean[i]!),
      degrees(path.deviation[i]!),
      degrees(c),
    ]);
  }

  protected override quantities(shown: Shown) {
    const { state } = shown;
    const [farthestDegrees, deviations, jerk] = this.#read(shown);
    const factor = (value: number) => `× ${this.number(value, value < 1 ? 3 : 1)}`;
    return {
      c: `${jerk} ×`,
      mu: `${farthestDegrees}°, ${deviations} σ`,
      sigma: factor(state.pose),
      delta: `${factor(state.velocity)}, ${factor(state.acceleration)}`,
    };
  }

  #read({ state, path, plain }: Shown): [farthest: string, deviations: string, jerk: string] {
    return [
      this.number(farthest(path), 2),
      this.number(farthestDeviations(path, state.pose), 2),
      this.number(jerkOf(path) / jerkOf(plain), 2),
    ];
  }

  protected draw(shown: Shown): void {
    const { state, path, plain } = shown;
    const inDegrees = (values: Float32Array) => Array.from(values, (value) => value * DEGREES);
    const [c, own, mean, deviation] = [path.c, plain.c, path.mean, plain.deviation].map(inDegrees) as [
      number[],
      number[],
      number[],
      number[],
    ];
    const deviations = mean.flatMap((m, i) => [m - deviation[i]!, m + deviation[i]!]);
    const axes = this.plot(
      { min: 0, max: c.length / WALK_HZ },
      roundedExtent([...c, ...own, ...deviations], LEAST_EXTENT),
      {
        x: this.words.chain.time,
        y: this.words.chain.angle(this.words.joints[state.joint]),
        columns: 6,
        digits: 1,
        rows: 4,
      },
    );
    const x = (frame: number) => axes.x(frame / WALK_HZ);
    const scale = Math.min(10, Math.sqrt(state.pose));
    this.#bands.replaceChildren(
      ...mean.map((m, i) => {
        const [low, high] = [axes.y(m - scale * deviation[i]!), axes.y(m + scale * deviation[i]!)];
        const [top, bottom] = [Math.max(axes.top, high), Math.min(axes.bottom, low)];
        return svg("rect", { x: x(i), y: top, width: x(i + 1) - x(i), height: Math.max(1, bottom - top) });
      }),
    );
    setAttributes(this.#stairs, { d: mean.map((m, i) => `M${x(i)} ${axes.y(m)}H${x(i + 1)}`).join("") });
    // A frame's value is drawn at its middle.
    const middles = this.frame.axes({ min: -0.5 / WALK_HZ, max: (c.length - 0.5) / WALK_HZ }, axes.up);
    const curve = (values: readonly number[]) => middles.curve(values, WALK_HZ);
    setAttributes(this.#own, { d: curve(own) });
    setAttributes(this.#curve, { d: curve(c) });
    setAttributes(this.#tangents, {
      d: tangents(
        c,
        (frame) => x(frame + 0.5),
        (value) => axes.y(value),
      ),
    });
    setText(this.readout, this.words.chain.read(...this.#read(shown)));
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
