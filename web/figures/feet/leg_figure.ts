/** A leg of two bones from the side: the ankle is dragged, and the knee follows. */
import { rounded } from "../../ui/controls/range";
import { setAttributes, setText, svg } from "../../ui/dom";
import type { FigureKind, FigureParts } from "../kind";
import { PlaneHandles } from "../plane_handles";
import { PlotFigure } from "../plot_figure";
import sheet from "./feet.css?inline";
import { type Leg, legOf, measureFeet, solveLeg } from "./feet_measure";
import { FEET_FIELDS, type FeetState, REACH } from "./feet_state";

/** Step of an arrow key, metres; with Shift the fine one. */
const STEP = { coarse: 0.02, fine: 0.002 };
/** The displayed area, metres below the hip and to its sides. */
const SHOWN = { top: 0.08, bottom: -0.88 };
/** Radius of the arc of γ, and of the hip, units. */
const ARC = 26;
/** Distance of labels from the bones, units. */
const LABEL = 14;

export const LEG: FigureKind<FeetState> = {
  fields: FEET_FIELDS,
  measure: measureFeet,
  sheet,
  create: (parts) => new LegFigure(parts),
};

interface Shown {
  state: FeetState;
  leg: Leg;
}

class LegFigure extends PlotFigure<FeetState, Shown> {
  readonly #bones = svg("path", { class: "bones" });
  readonly #distance = svg("path", { class: "distance", "data-term": "d" });
  readonly #arc = svg("path", { class: "angle", "data-term": "gamma" });
  readonly #labels = {
    a: svg("text", { class: "label" }),
    b: svg("text", { class: "label" }),
    gamma: svg("text", { class: "label y" }),
  };
  readonly #handles: PlaneHandles;

  constructor(parts: FigureParts<FeetState>) {
    const { feet } = parts.words;
    super(parts, feet.leg);
    const { picture, element } = this.frame;
    this.#handles = new PlaneHandles(
      picture,
      [feet.ankle],
      (fine) => (fine ? STEP.fine : STEP.coarse),
      {
        axes: () => this.axes,
        onInput: (_, [x, y]) => this.change({ x: rounded(x, REACH.x), y: rounded(y, REACH.y) }, false),
        onSettle: () => this.settle(),
      },
      parts.signal,
    );
    picture.append(this.#distance, this.#bones, this.#arc, ...Object.values(this.#labels), ...this.#handles.elements);
    this.lay({ title: feet.leg, picture: element });
  }

  protected async load(state: FeetState): Promise<Shown> {
    const lengths = await legOf(this.parts.engine, state.motion);
    return { state, leg: solveLeg(lengths, state.x, state.y) };
  }

  protected describe({ leg: { d, gamma, bend } }: Shown): string {
    return this.words.feet.bent(this.number(d, 3), this.number(gamma, 1), this.number(bend, 1));
  }

  protected get columns() {
    return this.words.feet.parts;
  }

  protected rows({ leg }: Shown): string[][] {
    const names = ["a", "b", "d", "gamma"] as const;
    return names.map((name) => [this.words.feet.rows[name], this.number(leg[name], name === "gamma" ? 1 : 3)]);
  }

  protected override quantities({ leg: { d, gamma } }: Shown) {
    return { d: `${this.number(d, 3)} m`, gamma: `${this.number(gamma, 1)}°` };
  }

  protected draw({ state, leg }: Shown): void {
    const { width, height } = this.frame;
    // The scale is equal in both directions.
    const perMetre = Math.max(1, height - 60) / (SHOWN.top - SHOWN.bottom);
    const half = Math.max(1, width - 60) / perMetre / 2;
    const { forwards, upwards } = this.words.feet;
    const axes = this.plot(
      { min: -half, max: half },
      { min: SHOWN.bottom, max: SHOWN.top },
      { x: forwards, y: upwards, columns: 6, digits: 1, rows: 4 },
    );
    const at = (x: number, y: number) => [axes.x(x), axes.y(y)] as const;
    const reach = leg.d / (Math.hypot(state.x, state.y) || 1);
    const [hip, ankle] = [at(0, 0), at(state.x * reach, state.y * reach)];
    const knee = at(...kneeOf(leg, state.x, state.y));
    const join = (...points: (readonly [number, number])[]) => `M${points.map(([x, y]) => `${x} ${y}`).join("L")}`;
    setAttributes(this.#bones, { d: join(hip, knee, ankle) });
    setAttributes(this.#distance, { d: join(hip, ankle) });
    const toward = ([x, y]: readonly [number, number]) => {
      const length = Math.hypot(x - knee[0], y - knee[1]) || 1;
      return [knee[0] + (ARC * (x - knee[0])) / length, knee[1] + (ARC * (y - knee[1])) / length] as const;
    };
    const [from, to] = [toward(hip), toward(ankle)];
    setAttributes(this.#arc, {
      d: `M${knee[0]} ${knee[1]}L${from[0]} ${from[1]}A${ARC} ${ARC} 0 0 0 ${to[0]} ${to[1]}Z`,
    });
    // Labels are outside the bend, where there is no bone.
    const away = [knee[0] - (hip[0] + ankle[0]) / 2, knee[1] - (hip[1] + ankle[1]) / 2] as const;
    const size = Math.hypot(...away) || 1;
    const [outX, outY] = away[0] === 0 && away[1] === 0 ? [1, 0] : [away[0] / size, away[1] / size];
    const label = (of: SVGTextElement, text: string, x: number, y: number) => {
      setText(of, text);
      const anchor = outX < 0 ? "end" : "start";
      setAttributes(of, { x: x + LABEL * outX, y: y + LABEL * outY + 4, "text-anchor": anchor });
    };
    const middle = (a: readonly [number, number], b: readonly [number, number]) =>
      [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] as const;
    label(this.#labels.a, `a ${this.number(leg.a, 3)} m`, ...middle(hip, knee));
    label(this.#labels.b, `b ${this.number(leg.b, 3)} m`, ...middle(knee, ankle));
    label(this.#labels.gamma, `γ ${this.number(leg.gamma, 1)}°`, ...knee);
    this.#handles.place(axes, [[state.x, state.y]], () => this.sentence());
    setText(this.readout, this.words.feet.reached(this.number(leg.d, 3), this.number(leg.gamma, 1)));
  }
}

/** Position of the knee relative to the hip, metres: in front of the line to the ankle. */
function kneeOf({ a, b, d }: Leg, x: number, y: number): readonly [x: number, y: number] {
  const length = Math.hypot(x, y) || 1;
  const [ux, uy] = [x / length, y / length];
  const along = d > 0 ? (a * a - b * b + d * d) / (2 * d) : 0;
  const aside = Math.sqrt(Math.max(0, a * a - along * along));
  return [along * ux - aside * uy, along * uy + aside * ux];
}
