/** A leg of two bones from the side: the ankle is dragged, and the knee follows. */
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, ticksOf, xOf, yOf } from "../axes";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlaneHandles } from "../plane_handles";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
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
  sheet,
  create: (parts) => new LegFigure(parts),
};

class LegFigure implements FigureInstance<FeetState> {
  readonly #parts: FigureParts<FeetState>;
  readonly #frame: PlotFrame;
  readonly #bones = svg("path", { class: "bones" });
  readonly #distance = svg("path", { class: "distance", "data-term": "d" });
  readonly #arc = svg("path", { class: "angle", "data-term": "gamma" });
  readonly #labels = {
    a: svg("text", { class: "label" }),
    b: svg("text", { class: "label" }),
    gamma: svg("text", { class: "label y" }),
  };
  readonly #handles: PlaneHandles;
  readonly #readout = html("p", { class: "readout" });
  readonly #solving = new Latest<FeetState>((state) => this.#solve(state));
  #state: FeetState | undefined;
  #shown: { state: FeetState; leg: Leg } | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<FeetState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.feet.leg, () => this.#drawNow(), signal);
    const clamp = (value: number, { min, max, digits }: { min: number; max: number; digits: number }) =>
      Number(Math.min(max, Math.max(min, value)).toFixed(digits));
    const { picture } = this.#frame;
    this.#handles = new PlaneHandles(
      picture,
      [words.feet.ankle],
      (fine) => (fine ? STEP.fine : STEP.coarse),
      {
        axes: () => this.#axes,
        onInput: (_, [x, y]) => change({ x: clamp(x, REACH.x), y: clamp(y, REACH.y) }, false),
        onSettle: () => change({}, true),
      },
      signal,
    );
    picture.append(this.#distance, this.#bones, this.#arc, ...Object.values(this.#labels), ...this.#handles.elements);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.feet.leg)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  show(state: FeetState): Promise<void> {
    this.#state = state;
    return this.#solving.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureFeet(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#shown) return "";
    const { words } = this.#parts;
    const { d, gamma, bend } = this.#shown.leg;
    return words.feet.bent(figure(d, 3, words), figure(gamma, 1, words), figure(bend, 1, words));
  }

  table(): Table {
    const { words } = this.#parts;
    const leg = this.#shown?.leg;
    const { rows } = words.feet;
    const names = ["a", "b", "d", "gamma"] as const;
    const values = leg ? names.map((name) => [rows[name], figure(leg[name], name === "gamma" ? 1 : 3, words)]) : [];
    return { head: words.feet.parts, rows: values };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#shown) return {};
    const { words } = this.#parts;
    const { d, gamma } = this.#shown.leg;
    return { d: `${figure(d, 3, words)} m`, gamma: `${figure(gamma, 1, words)}°` };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  async #solve(state: FeetState): Promise<void> {
    const lengths = await legOf(this.#parts.engine, state.motion);
    if (this.#parts.signal.aborted) return;
    this.#shown = { state, leg: solveLeg(lengths, state.x, state.y) };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#shown) return;
    const { words } = this.#parts;
    const { state, leg } = this.#shown;
    const [width, height] = [this.#frame.width, this.#frame.height];
    // The scale is equal in both directions.
    const perMetre = Math.max(1, height - 60) / (SHOWN.top - SHOWN.bottom);
    const half = Math.max(1, width - 60) / perMetre / 2;
    const axes: Axes = { width, height, x: [-half, half], y: [SHOWN.bottom, SHOWN.top] };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 6).map((value) => [value, figure(value, 1, words)] as const);
    const labels = { x: words.feet.forwards, y: words.feet.upwards, columns, rows: ticksOf(axes.y, 4) };
    this.#frame.drawGrid(axes, labels, words);
    const at = (x: number, y: number) => [xOf(axes, x), yOf(axes, y)] as const;
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
    label(this.#labels.a, `a ${figure(leg.a, 3, words)} m`, ...middle(hip, knee));
    label(this.#labels.b, `b ${figure(leg.b, 3, words)} m`, ...middle(knee, ankle));
    label(this.#labels.gamma, `γ ${figure(leg.gamma, 1, words)}°`, ...knee);
    this.#handles.place(axes, [[state.x, state.y]], () => this.sentence());
    setText(this.#readout, words.feet.reached(figure(leg.d, 3, words), figure(leg.gamma, 1, words)));
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
