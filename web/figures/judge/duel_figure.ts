/** The errors of two methods over the time of a take, and the instants at which the learner says that one is better. */
import { button } from "../../ui/controls/buttons";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, curvePath, extentOf, ticksOf, valueOfX, xOf, yOf } from "../axes";
import { RATE_HZ } from "../built_in";
import { Choice } from "../controls";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./judge.css?inline";
import { correctionAt, measureJudge, type Trial, trialOf } from "./judge_measure";
import { JUDGE_FIELDS, type JudgeState, METHODS, type Method } from "./judge_state";

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
  sheet,
  create: (parts) => new DuelFigure(parts),
};

class DuelFigure implements FigureInstance<JudgeState> {
  readonly #parts: FigureParts<JudgeState>;
  readonly #frame: PlotFrame;
  readonly #rival: Choice<Method>;
  readonly #between: Record<Side, SVGPathElement>;
  readonly #curves: Record<Side, SVGPathElement>;
  readonly #points: Record<Side, SVGCircleElement>;
  readonly #flags: Record<Side, SVGGElement>;
  readonly #buttons: Record<Side, HTMLButtonElement>;
  readonly #handle: Handle;
  readonly #readout = html("p", { class: "readout" });
  readonly #trying = new Latest<JudgeState>((state) => this.#try(state));
  readonly #correcting = new Latest<JudgeState>((state) => this.#correct(state));
  #state: JudgeState | undefined;
  /** β⊤(u − ū) at the playhead, degrees. */
  #correction: number | undefined;
  #shown: { key: string; trials: Record<Side, Trial> } | undefined;
  #axes: Axes | undefined;
  /** Key of the curves and their size: moving the playhead does not draw them again. */
  #curvesOf = "";

  constructor(parts: FigureParts<JudgeState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    const both = <T>(make: (side: Side) => T) =>
      Object.fromEntries(SIDES.map((side) => [side, make(side)])) as Record<Side, T>;
    this.#frame = new PlotFrame(words.judge.duel, () => this.#drawNow(), signal);
    const { picture } = this.#frame;
    this.#rival = new Choice(
      words.judge.rival,
      METHODS.map((method) => [method, words.judge.names[method]] as const),
      (rival) => change({ rival }, true),
    );
    this.#between = both((side) => svg("path", { class: `between ${side}` }));
    this.#curves = both((side) => svg("path", { class: side === "pick" ? "curve chosen" : "curve", "data-term": "p" }));
    this.#points = both((side) =>
      svg("circle", { class: side === "pick" ? "point chosen" : "point", r: 4, "data-term": "p" }),
    );
    this.#flags = both((side) =>
      svg(
        "g",
        { class: `pin ${side}` },
        svg("path", { d: "M0 0v-14h10l-3 3.5l3 3.5h-10" }),
        svg("text", { x: 12, y: -6 }),
      ),
    );
    this.#buttons = both((side) => {
      const pin = button("", () => change({ [PINS[side]]: this.#at() }, true), { class: `pin outlined ${side}` });
      pin.removeAttribute("title");
      return pin;
    });
    this.#handle = new Handle(
      words.playhead,
      "i",
      picture,
      {
        value: () => this.#axes && this.#state && this.#at(),
        valueOf: (x) => valueOfX(this.#axes!, x) * RATE_HZ,
        stepped: (at, direction, fine) => at + direction * (fine ? 1 : STEP),
        ends: () => [0, this.#frames() - 1],
        onInput: (at) => change({ at: Math.round(at) }, false),
        onSettle: () => change({}, true),
      },
      signal,
    );
    picture.append(this.#between.pick, this.#between.rival, this.#curves.rival, this.#curves.pick);
    picture.append(...Object.values(this.#flags), ...Object.values(this.#points), this.#handle.element);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.judge.duel), this.#rival.element),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs pins" }, this.#buttons.pick, this.#buttons.rival),
    );
  }

  show(state: JudgeState): Promise<void> {
    this.#state = state;
    this.#rival.value = state.rival;
    for (const side of SIDES) {
      const name = this.#parts.words.judge.pin(this.#name(side));
      setText(this.#buttons[side], name);
      this.#buttons[side].setAttribute("aria-label", name);
    }
    this.#draw();
    return Promise.all([this.#trying.take(state), this.#correcting.take(state)]).then(() => {});
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureJudge(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const shown = this.#shown;
    if (!shown || !this.#state) return "";
    const { words } = this.#parts;
    const at = this.#at();
    const said = SIDES.flatMap((side) => [this.#name(side), this.#mm(shown.trials[side].errors[at]!)]) as Four;
    return words.judge.duelled(figure(at / RATE_HZ, 2, words), ...said, this.#difference());
  }

  table(): Table {
    const { words } = this.#parts;
    const trials = this.#shown?.trials;
    const rows: string[][] = [];
    for (let frame = 0; trials && frame < this.#frames(); frame += TABLE_STEP)
      rows.push([figure(frame / RATE_HZ, 1, words), ...SIDES.map((side) => this.#mm(trials[side].errors[frame]!))]);
    const names = this.#state ? SIDES.map((side) => `${this.#name(side)}, mm`) : [];
    return { head: [words.time, ...names], rows };
  }

  values(): Readonly<Record<string, string>> {
    const shown = this.#shown;
    if (!shown || !this.#state) return {};
    const { words } = this.#parts;
    const at = this.#at();
    const u = this.#correction;
    return {
      ...(u !== undefined && { u: `${figure(u, 2, words)}°` }),
      i: `${figure(at / RATE_HZ, 2, words)} s`,
      p: `${this.#mm(shown.trials.pick.errors[at]!)} mm`,
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  #name(side: Side): string {
    return this.#parts.words.judge.names[this.#state![side]];
  }

  #mm(value: number): string {
    return figure(value, 2, this.#parts.words);
  }

  /** Difference of the two methods' errors at the playhead. */
  #difference(): string {
    const { pick, rival } = this.#shown!.trials;
    const more = rival.errors[this.#at()]! - pick.errors[this.#at()]!;
    return `${more < 0 ? "" : "+"}${figure(more, 2, this.#parts.words)}`;
  }

  #frames(): number {
    return this.#shown?.trials.pick.errors.length ?? 1;
  }

  #at(): number {
    return Math.min(this.#state!.at, this.#frames() - 1);
  }

  async #try(state: JudgeState): Promise<void> {
    const { take, style, leftIn, pick, rival } = state;
    const key = JSON.stringify([take, style, leftIn, pick, rival]);
    if (this.#shown?.key === key) return;
    const { engine, signal, words } = this.#parts;
    setText(this.#readout, words.judge.computing);
    const [one, other] = await Promise.all([pick, rival].map((method) => trialOf(engine, take, style, leftIn, method)));
    if (signal.aborted) return;
    this.#shown = { key, trials: { pick: one!, rival: other! } };
    this.#draw();
  }

  async #correct(state: JudgeState): Promise<void> {
    this.#correction = await correctionAt(this.#parts.engine, state, state.at);
    if (!this.#parts.signal.aborted) this.#parts.changed();
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const shown = this.#shown;
    if (!shown || !this.#state) return;
    const { trials } = shown;
    const { words } = this.#parts;
    const { width, height } = this.#frame;
    const curves = [shown.key, width, height].join("/");
    if (!this.#axes || this.#curvesOf !== curves) {
      this.#curvesOf = curves;
      const secs = (this.#frames() - 1) / RATE_HZ;
      const y = extentOf([0, ...trials.pick.errors, ...trials.rival.errors], LEAST_EXTENT);
      const axes: Axes = { width, height, x: [0, secs], y };
      this.#axes = axes;
      const columns = ticksOf(axes.x, 7).map((value) => [value, figure(value, 0, words)] as const);
      this.#frame.drawGrid(axes, { x: words.time, y: words.judge.error, columns, rows: ticksOf(y, 4) }, words);
      for (const side of SIDES) {
        setAttributes(this.#curves[side], { d: curvePath(axes, trials[side].errors, RATE_HZ) });
        setAttributes(this.#between[side], {
          d: betweenPath(axes, trials[side].errors, trials[OTHER[side]].errors),
        });
      }
    }
    this.#drawInstants(this.#axes, trials);
    const said = SIDES.flatMap((side) => [this.#name(side), this.#mm(trials[side].pose)]) as Four;
    setText(this.#readout, words.judge.duelMeans(...said, this.#difference()));
  }

  #drawInstants(axes: Axes, trials: Record<Side, Trial>): void {
    const at = this.#at();
    const x = xOf(axes, at / RATE_HZ);
    for (const side of SIDES) {
      setAttributes(this.#points[side], { cx: x, cy: yOf(axes, trials[side].errors[at]!) });
      const pin = this.#state![PINS[side]];
      const error = trials[side].errors[pin];
      setAttributes(this.#flags[side], {
        visibility: error === undefined ? "hidden" : "visible",
        transform: `translate(${xOf(axes, Math.max(0, pin) / RATE_HZ)} ${yOf(axes, error ?? 0)})`,
      });
      setText(this.#flags[side].lastElementChild!, this.#name(side));
    }
    this.#handle.place({ x, bottom: yOf(axes, axes.y[0]), value: at, text: this.sentence() });
  }
}

type Four = [name: string, mm: string, other: string, otherMm: string];

/** The area between two curves where the first is lower. */
function betweenPath(axes: Axes, lower: Float64Array, upper: Float64Array): string {
  const column = (frame: number) => {
    const x = xOf(axes, frame / RATE_HZ).toFixed(1);
    const [bottom, top] = [lower[frame]!, Math.max(lower[frame]!, upper[frame]!)];
    return [`${x} ${yOf(axes, bottom).toFixed(1)}`, `${x} ${yOf(axes, top).toFixed(1)}`] as const;
  };
  const columns = Array.from(lower, (_, frame) => column(frame));
  const back = columns.map(([, top]) => top).reverse();
  return `M${columns.map(([bottom]) => bottom).join("L")}L${back.join("L")}Z`;
}
