/** The errors of two methods over the time of a take, and the instants at which the learner says that one is better. */
import { button } from "../../ui/controls/buttons";
import { setAttributes, setText, svg } from "../../ui/dom";
import { LatestOnly } from "../../ui/latest_only";
import { roundedExtent } from "../../ui/scale";
import type { Axes } from "../axes";
import { RATE_HZ } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import sheet from "./judge.css?inline";
import { correctionAt, measureJudge, type Trial, trialOf } from "./judge_measure";
import { JUDGE_FIELDS, type JudgeState, METHODS } from "./judge_state";

/** Step of an arrow key, frames; with Shift one frame. */
const STEP = 10;
/** Frames between two rows of the table. */
const TABLE_STEP = 60;
/** Minimum range of the errors, mm. */
const LEAST_EXTENT = 5;
/** The compared methods: the selected one, and the other one. */
const SIDES = ["pick", "rival"] as const;
type Side = (typeof SIDES)[number];
const PINS = { pick: "pickPin", rival: "rivalPin" } as const satisfies Record<Side, keyof JudgeState>;
const OTHER = { pick: "rival", rival: "pick" } as const satisfies Record<Side, Side>;

export const DUEL: FigureKind<JudgeState> = {
  fields: JUDGE_FIELDS,
  measure: measureJudge,
  sheet,
  create: (parts) => new DuelFigure(parts),
};

interface Shown {
  key: string;
  trials: Record<Side, Trial>;
}

class DuelFigure extends PlotFigure<JudgeState, Shown> {
  readonly #between = both((side) => svg("path", { class: `between ${side}` }));
  readonly #curves = both((side) =>
    svg("path", { class: side === "pick" ? "curve chosen" : "curve", "data-term": "p" }),
  );
  readonly #points = both((side) =>
    svg("circle", { class: side === "pick" ? "point chosen" : "point", r: 4, "data-term": "p" }),
  );
  readonly #flags = both((side) =>
    svg(
      "g",
      { class: `pin ${side}` },
      svg("path", { d: "M0 0v-14h10l-3 3.5l3 3.5h-10" }),
      svg("text", { x: 12, y: -6 }),
    ),
  );
  readonly #buttons = both((side) => {
    const pin = button("", () => this.change({ [PINS[side]]: this.#at() }), { class: `pin outlined ${side}` });
    pin.removeAttribute("title");
    return pin;
  });
  readonly #handle = this.playhead("at", {
    step: STEP,
    rate: () => RATE_HZ,
    ends: () => [0, this.#frames() - 1],
  });
  readonly #correcting = new LatestOnly<JudgeState>((state) => this.#correct(state));
  /** β⊤(u − ū) at the playhead, degrees. */
  #correction: number | undefined;
  /** Key of the drawn curves and their size: moving the playhead does not draw them again. */
  #drawn = "";
  protected override readonly drawsAhead = true;

  constructor(parts: FigureParts<JudgeState>) {
    const { judge } = parts.words;
    super(parts, judge.duel);
    const { picture, element } = this.frame;
    picture.append(this.#between.pick, this.#between.rival, this.#curves.rival, this.#curves.pick);
    picture.append(...Object.values(this.#flags), ...Object.values(this.#points), this.#handle.element);
    this.lay({
      title: judge.duel,
      picture: element,
      head: [this.choice("rival", judge.rival, METHODS, (method) => judge.names[method])],
      controls: [this.#buttons.pick, this.#buttons.rival],
      controlsClass: "knobs pins",
    });
  }

  override async show(state: JudgeState): Promise<void> {
    for (const side of SIDES) {
      const name = this.words.judge.pin(this.words.judge.names[state[side]]);
      setText(this.#buttons[side], name);
      this.#buttons[side].setAttribute("aria-label", name);
    }
    await Promise.all([super.show(state), this.#correcting.take(state)]);
  }

  protected async load({ take, style, leftIn, pick, rival }: JudgeState): Promise<Shown> {
    const key = JSON.stringify([take, style, leftIn, pick, rival]);
    if (this.shown?.key === key) return this.shown;
    const { engine } = this.parts;
    setText(this.readout, this.words.judge.computing);
    const [one, other] = await Promise.all([pick, rival].map((method) => trialOf(engine, take, style, leftIn, method)));
    return { key, trials: { pick: one!, rival: other! } };
  }

  protected describe({ trials }: Shown): string {
    const at = this.#at();
    const said = SIDES.flatMap((side) => [this.#name(side), this.#mm(trials[side].errors[at]!)]) as Four;
    return this.words.judge.duelled(this.number(at / RATE_HZ, 2), ...said, this.#difference(trials));
  }

  protected get columns() {
    const names = this.state ? SIDES.map((side) => `${this.#name(side)}, mm`) : [];
    return [this.words.time, ...names];
  }

  protected rows({ trials }: Shown): string[][] {
    return Array.from({ length: Math.ceil(this.#frames() / TABLE_STEP) }, (_, i) => {
      const frame = i * TABLE_STEP;
      return [this.number(frame / RATE_HZ, 1), ...SIDES.map((side) => this.#mm(trials[side].errors[frame]!))];
    });
  }

  protected override quantities({ trials }: Shown) {
    const at = this.#at();
    const u = this.#correction;
    return {
      ...(u !== undefined && { u: `${this.number(u, 2)}°` }),
      i: `${this.number(at / RATE_HZ, 2)} s`,
      p: `${this.#mm(trials.pick.errors[at]!)} mm`,
    };
  }

  #name(side: Side): string {
    return this.words.judge.names[this.state![side]];
  }

  #mm(value: number): string {
    return this.number(value, 2);
  }

  /** Difference of the two methods' errors at the playhead. */
  #difference({ pick, rival }: Record<Side, Trial>): string {
    const more = rival.errors[this.#at()]! - pick.errors[this.#at()]!;
    return `${more < 0 ? "" : "+"}${this.number(more, 2)}`;
  }

  #frames(): number {
    return this.shown?.trials.pick.errors.length ?? 1;
  }

  #at(): number {
    return Math.min(this.state!.at, this.#frames() - 1);
  }

  async #correct(state: JudgeState): Promise<void> {
    this.#correction = await correctionAt(this.parts.engine, state, state.at);
    if (!this.parts.signal.aborted) this.parts.changed();
  }

  protected draw({ key, trials }: Shown): void {
    const { width, height } = this.frame;
    const drawn = [key, width, height].join("/");
    let { axes } = this;
    if (!axes || this.#drawn !== drawn) {
      this.#drawn = drawn;
      const secs = (this.#frames() - 1) / RATE_HZ;
      const up = roundedExtent([0, ...trials.pick.errors, ...trials.rival.errors], LEAST_EXTENT);
      const labels = { x: this.words.time, y: this.words.judge.error, columns: 7, digits: 0, rows: 4 };
      axes = this.plot({ min: 0, max: secs }, up, labels);
      for (const side of SIDES) {
        setAttributes(this.#curves[side], { d: axes.curve(trials[side].errors, RATE_HZ) });
        setAttributes(this.#between[side], {
          d: betweenPath(axes, trials[side].errors, trials[OTHER[side]].errors),
        });
      }
    }
    this.#drawInstants(axes, trials);
    const said = SIDES.flatMap((side) => [this.#name(side), this.#mm(trials[side].pose)]) as Four;
    setText(this.readout, this.words.judge.duelMeans(...said, this.#difference(trials)));
  }

  #drawInstants(axes: Axes, trials: Record<Side, Trial>): void {
    const at = this.#at();
    const x = axes.x(at / RATE_HZ);
    for (const side of SIDES) {
      setAttributes(this.#points[side], { cx: x, cy: axes.y(trials[side].errors[at]!) });
      const pin = this.state![PINS[side]];
      const error = trials[side].errors[pin];
      setAttributes(this.#flags[side], {
        visibility: error === undefined ? "hidden" : "visible",
        transform: `translate(${axes.x(Math.max(0, pin) / RATE_HZ)} ${axes.y(error ?? 0)})`,
      });
      setText(this.#flags[side].lastElementChild!, this.#name(side));
    }
    this.#handle.place({ x, bottom: axes.bottom, value: at, text: this.sentence() });
  }
}

function both<T>(make: (side: Side) => T): Record<Side, T> {
  return Object.fromEntries(SIDES.map((side) => [side, make(side)])) as Record<Side, T>;
}

type Four = [name: string, mm: string, other: string, otherMm: string];

/** The area between two curves where the first is lower. */
function betweenPath(axes: Axes, lower: Float64Array, upper: Float64Array): string {
  const column = (frame: number) => {
    const x = axes.x(frame / RATE_HZ).toFixed(1);
    const [bottom, top] = [lower[frame]!, Math.max(lower[frame]!, upper[frame]!)];
    return [`${x} ${axes.y(bottom).toFixed(1)}`, `${x} ${axes.y(top).toFixed(1)}`] as const;
  };
  const columns = Array.from(lower, (_, frame) => column(frame));
  const back = columns.map(([, top]) => top).reverse();
  return `M${columns.map(([bottom]) => bottom).join("L")}L${back.join("L")}Z`;
}
