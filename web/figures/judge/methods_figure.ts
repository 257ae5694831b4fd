/** Results of the methods on motion that is not in their data: error, roughness and content, with their floors. */
import type { Segment } from "../../ui/controls/buttons";
import { html, setText } from "../../ui/dom";
import { LatestOnly } from "../../ui/latest_only";
import type { FigureKind, FigureParts } from "../kind";
import { LiveFigure } from "../live_figure";
import sheet from "./judge.css?inline";
import { measureJudge, standingOn, trialOf } from "./judge_measure";
import { HONEST, type Honest, JUDGE_FIELDS, type JudgeState, METHODS, type Method, SOURCES } from "./judge_state";
import { type Achieved, CONTENT_LEFT, RECORDED, type Standing } from "./recorded";

/** Length of the longest bar, in multiples of the error of another real take: an unchanged input may exceed it. */
const FULL = 4;
/** Limits of the acceleration axis, relative to the input's. */
const [GENTLE, ROUGH] = [0.25, 12];
/** Methods of the bet: they are shown after it. */
const BET_ON: readonly Method[] = ["knn", "lar", "mar"];

const COLUMNS = ["pose", "acceleration", "content"] as const;
type Column = (typeof COLUMNS)[number];
const TERMS: Readonly<Record<Column, string>> = { pose: "e", acceleration: "acceleration", content: "content" };

export const METHODS_KIND: FigureKind<JudgeState> = {
  fields: JUDGE_FIELDS,
  measure: measureJudge,
  sheet,
  create: (parts) => new MethodsFigure(parts),
};

interface Row {
  element: HTMLElement;
  radio: HTMLInputElement;
}

interface Shown {
  key: string;
  standing: Standing;
}

class MethodsFigure extends LiveFigure<JudgeState, Shown> {
  readonly #honest: Segment<Honest>;
  readonly #rows: ReadonlyMap<Method, Row>;
  readonly #list: HTMLElement;
  readonly #comparing = new LatestOnly<JudgeState>((state) => this.#compare(state));

  constructor(parts: FigureParts<JudgeState>) {
    super(parts);
    const said = parts.words.judge;
    this.#honest = this.segment("honest", said.honestOne, HONEST, (value) => said.honest[value](""));
    this.#rows = new Map(METHODS.map((method) => [method, this.#row(method)]));
    const head = html(
      "div",
      { class: "method heads" },
      html("span", {}),
      ...COLUMNS.map((column) => html("span", { "data-term": TERMS[column] }, said.columns[column])),
    );
    const rows = [...this.#rows.values()].map(({ element }) => element);
    const group = html("div", { class: "choices", role: "radiogroup", "aria-label": said.methods }, ...rows);
    this.#list = html("div", { class: "methods" }, head, group);
    this.lay({
      title: said.title,
      picture: html("div", { class: "picture listed" }, this.#list),
      head: [this.choice("source", said.source, SOURCES, (source) => said.sources[source])],
      controls: [
        this.toggle("leftIn", said.leaveIn),
        html("div", { class: "honest" }, html("span", {}, said.honestOne), this.#honest.element),
      ],
    });
  }

  override async show(state: JudgeState): Promise<void> {
    for (const [method, { element, radio }] of this.#rows) {
      radio.checked = method === state.pick;
      element.classList.toggle("picked", radio.checked);
      element.classList.toggle("rival", method === state.rival);
    }
    await Promise.all([super.show(state), this.#comparing.take(state)]);
  }

  protected async load(state: JudgeState): Promise<Shown> {
    const { engine, signal } = this.parts;
    const { source, take, style, leftIn } = state;
    const key = source === "live" ? JSON.stringify([take, style, leftIn]) : source;
    if (this.shown?.key === key) return this.shown;
    this.#list.setAttribute("aria-busy", "true");
    setText(this.readout, this.words.judge.computing);
    const drawSoFar = (sofar: Standing) => {
      if (signal.aborted) return;
      this.#drawRows(sofar);
      this.parts.changed();
    };
    return { key, standing: source === "live" ? await standingOn(engine, state, drawSoFar) : RECORDED[source] };
  }

  protected redraw(): void {
    const { judge } = this.words;
    const { standing } = this.shown!;
    this.#list.setAttribute("aria-busy", "false");
    this.#drawRows(standing);
    const floors = this.#floors(standing).map(([name, mm]) => judge.floor(name, this.number(mm, 2)));
    setText(this.readout, floors.length > 0 ? floors.join("; ") : judge.noTruth);
    this.parts.changed();
  }

  protected describe({ standing }: Shown, state: JudgeState): string {
    const { judge, styles } = this.words;
    const { source, take, style, leftIn, pick } = state;
    const where = source === "live" ? judge.where(take, styles[style], leftIn) : judge.sources[source];
    const of = standing.methods.get(pick);
    return of
      ? judge.achieved(where, judge.names[pick], ...this.#said(of))
      : judge.notMeasured(where, judge.names[pick]);
  }

  protected get columns() {
    return ["", ...COLUMNS.map((column) => this.words.judge.columns[column])];
  }

  protected rows({ standing }: Shown): string[][] {
    const methods = METHODS.flatMap((method) => {
      const of = standing.methods.get(method);
      return of ? [[this.words.judge.names[method], ...this.#said(of)]] : [];
    });
    return [...methods, ...this.#floors(standing).map(([name, mm]) => [name, this.number(mm, 2), "", ""])];
  }

  protected override quantities({ standing }: Shown, { pick }: JudgeState): Readonly<Record<string, string>> {
    const of = standing.methods.get(pick);
    if (!of) return {};
    const [pose, acceleration, content] = this.#said(of);
    return { e: of.pose === undefined ? "–" : `${pose} mm`, acceleration: `${acceleration} ×`, content };
  }

  #row(method: Method): Row {
    const { names } = this.words.judge;
    const radio = html("input", { type: "radio", name: "method", value: method });
    radio.addEventListener("change", () => this.change({ pick: method }));
    const cell = (column: Column) =>
      html(
        "span",
        { class: `cell ${column}`, "data-term": TERMS[column] },
        html("i", { class: "bar" }),
        html("span", { class: "number" }),
      );
    const name = html("span", { class: "name" }, names[method]);
    const kind = BET_ON.includes(method) ? "method bet-on" : "method";
    return { element: html("label", { class: kind }, radio, name, ...COLUMNS.map(cell)), radio };
  }

  #said({ pose, acceleration, content }: Achieved): [pose: string, acceleration: string, content: string] {
    return [pose === undefined ? "–" : this.number(pose, 2), this.number(acceleration, 2), this.number(content, 2)];
  }

  #floors({ unchanged, otherTake }: Standing): [name: string, mm: number][] {
    const { judge } = this.words;
    const floors: [string, number | undefined][] = [
      [judge.unchanged, unchanged],
      [this.state?.source === "live" ? judge.otherTakeRecorded : judge.otherTake, otherTake],
    ];
    return floors.filter((floor): floor is [string, number] => floor[1] !== undefined);
  }

  /** Shows the error of the nearest neighbour with the take held out, and left in. */
  async #compare({ take, style }: JudgeState): Promise<void> {
    const { engine, signal } = this.parts;
    const [out, left] = await Promise.all([false, true].map((is) => trialOf(engine, take, style, is, "nn")));
    if (signal.aborted) return;
    const { honest } = this.words.judge;
    this.#honest.relabel("out", honest.out(this.number(out!.pose, 2)));
    this.#honest.relabel("in", honest.in(this.number(left!.pose, 2)));
  }

  #drawRows(standing: Standing): void {
    const most = FULL * (standing.otherTake ?? 1);
    const share = (value: number) => String(Math.min(1, Math.max(0, value)));
    this.#list.style.setProperty("--enough", share(CONTENT_LEFT));
    this.#list.style.setProperty("--floor", share((standing.otherTake ?? 0) / most));
    this.#list.classList.toggle("floored", standing.otherTake !== undefined);
    for (const [method, { element }] of this.#rows) {
      const of = standing.methods.get(method);
      element.classList.toggle("missing", of === undefined);
      const said = of ? this.#said(of) : ["–", "–", "–"];
      const shares = of
        ? [(of.pose ?? 0) / most, Math.log(of.acceleration / GENTLE) / Math.log(ROUGH / GENTLE), of.content]
        : [0, 0, 0];
      COLUMNS.forEach((column, i) => {
        const cell = element.querySelector<HTMLElement>(`.${column}`)!;
        setText(cell.querySelector(".number")!, said[i]!);
        cell.querySelector<HTMLElement>(".bar")!.style.setProperty("--share", share(shares[i]!));
      });
    }
    this.#list.style.setProperty("--even", share(Math.log(1 / GENTLE) / Math.log(ROUGH / GENTLE)));
  }
}
