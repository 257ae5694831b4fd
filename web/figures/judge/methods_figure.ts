/** Results of the methods on motion that is not in their data: error, roughness and content, with their floors. */
import { Segment, Toggle } from "../../ui/controls/buttons";
import { html, setText } from "../../ui/dom";
import { Choice } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { figure } from "../words/words";
import sheet from "./judge.css?inline";
import { measureJudge, standingOn, trialOf } from "./judge_measure";
import {
  HONEST,
  type Honest,
  JUDGE_FIELDS,
  type JudgeState,
  METHODS,
  type Method,
  SOURCES,
  type Source,
} from "./judge_state";
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
  sheet,
  create: (parts) => new MethodsFigure(parts),
};

interface Row {
  element: HTMLElement;
  radio: HTMLInputElement;
}

class MethodsFigure implements FigureInstance<JudgeState> {
  readonly #parts: FigureParts<JudgeState>;
  readonly #source: Choice<Source>;
  readonly #leftIn: Toggle;
  readonly #honest: Segment<Honest>;
  readonly #rows: ReadonlyMap<Method, Row>;
  readonly #list: HTMLElement;
  readonly #readout = html("p", { class: "readout" });
  readonly #standing = new Latest<JudgeState>((state) => this.#stand(state));
  #state: JudgeState | undefined;
  #shown: { key: string; standing: Standing } | undefined;

  constructor(parts: FigureParts<JudgeState>) {
    this.#parts = parts;
    const { words, container, change } = parts;
    const said = words.judge;
    this.#source = new Choice(
      said.source,
      SOURCES.map((source) => [source, said.sources[source]] as const),
      (source) => change({ source }, true),
    );
    this.#leftIn = new Toggle(said.leaveIn, (leftIn) => change({ leftIn }, true));
    const options = HONEST.map((value) => ({ value, label: said.honest[value]("") }));
    this.#honest = new Segment(said.honestOne, options, (honest) => change({ honest }, true));
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
    container.append(
      html("header", { class: "head" }, html("h3", {}, said.title), this.#source.element),
      html("div", { class: "picture listed" }, this.#list),
      html("footer", { class: "foot" }, this.#readout),
      html(
        "div",
        { class: "knobs" },
        this.#leftIn.element,
        html("div", { class: "honest" }, html("span", {}, said.honestOne), this.#honest.element),
      ),
    );
    for (const mark of this.#list.querySelectorAll("[data-term]")) {
      mark.addEventListener("pointerenter", () => parts.point(mark.getAttribute("data-term")!));
      mark.addEventListener("pointerleave", () => parts.point(undefined));
    }
  }

  show(state: JudgeState): Promise<void> {
    this.#state = state;
    this.#source.value = state.source;
    this.#leftIn.on = state.leftIn;
    this.#honest.value = state.honest;
    for (const [method, { element, radio }] of this.#rows) {
      radio.checked = method === state.pick;
      element.classList.toggle("picked", radio.checked);
      element.classList.toggle("rival", method === state.rival);
    }
    return this.#standing.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureJudge(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const [state, shown] = [this.#state, this.#shown];
    if (!state || !shown) return "";
    const { words } = this.#parts;
    const where =
      state.source === "live"
        ? words.judge.where(state.take, words.styles[state.style], state.leftIn)
        : words.judge.sources[state.source];
    const of = shown.standing.methods.get(state.pick);
    const name = words.judge.names[state.pick];
    return of ? words.judge.achieved(where, name, ...this.#said(of)) : words.judge.notMeasured(where, name);
  }

  table(): Table {
    const { words } = this.#parts;
    const standing = this.#shown?.standing;
    const methods = METHODS.flatMap((method) => {
      const of = standing?.methods.get(method);
      return of ? [[words.judge.names[method], ...this.#said(of)]] : [];
    });
    const floors = this.#floors().map(([name, mm]) => [name, figure(mm, 2, words), "", ""]);
    return { head: ["", ...COLUMNS.map((column) => words.judge.columns[column])], rows: [...methods, ...floors] };
  }

  values(): Readonly<Record<string, string>> {
    const of = this.#state && this.#shown?.standing.methods.get(this.#state.pick);
    if (!of) return {};
    const { words } = this.#parts;
    const [pose] = this.#said(of);
    return {
      e: of.pose === undefined ? "–" : `${pose} mm`,
      acceleration: `${figure(of.acceleration, 2, words)} ×`,
      content: figure(of.content, 2, words),
    };
  }

  light(term: string | undefined): void {
    for (const mark of this.#list.querySelectorAll("[data-term]"))
      mark.classList.toggle("lit", mark.getAttribute("data-term") === term);
  }

  #row(method: Method): Row {
    const { words, change } = this.#parts;
    const radio = html("input", { type: "radio", name: "method", value: method });
    radio.addEventListener("change", () => change({ pick: method }, true));
    const cell = (column: Column) =>
      html(
        "span",
        { class: `cell ${column}`, "data-term": TERMS[column] },
        html("i", { class: "bar" }),
        html("span", { class: "number" }),
      );
    const name = html("span", { class: "name" }, words.judge.names[method]);
    const kind = BET_ON.includes(method) ? "method bet-on" : "method";
    return { element: html("label", { class: kind }, radio, name, ...COLUMNS.map(cell)), radio };
  }

  #said({ pose, acceleration, content }: Achieved): [pose: string, acceleration: string, content: string] {
    const { words } = this.#parts;
    return [
      pose === undefined ? "–" : figure(pose, 2, words),
      figure(acceleration, 2, words),
      figure(content, 2, words),
    ];
  }

  #floors(): [name: string, mm: number][] {
    const { unchanged, otherTake } = this.#shown?.standing ?? {};
    const { judge } = this.#parts.words;
    const floors: [string, number | undefined][] = [
      [judge.unchanged, unchanged],
      [this.#state?.source === "live" ? judge.otherTakeRecorded : judge.otherTake, otherTake],
    ];
    return floors.filter((floor): floor is [string, number] => floor[1] !== undefined);
  }

  async #stand(state: JudgeState): Promise<void> {
    const { engine, signal, words } = this.#parts;
    const { source, take, style, leftIn } = state;
    const key = source === "live" ? JSON.stringify([take, style, leftIn]) : source;
    if (this.#shown?.key !== key) {
      this.#list.setAttribute("aria-busy", "true");
      setText(this.#readout, words.judge.computing);
      const drawSoFar = (sofar: Standing) => {
        if (signal.aborted) return;
        this.#drawRows(sofar);
        this.#parts.changed();
      };
      const standing = source === "live" ? await standingOn(engine, state, drawSoFar) : RECORDED[source];
      if (signal.aborted) return;
      this.#shown = { key, standing };
      this.#list.setAttribute("aria-busy", "false");
    }
    this.#draw();
    this.#parts.changed();
    const [out, left] = await Promise.all([false, true].map((is) => trialOf(engine, take, style, is, "nn")));
    if (signal.aborted) return;
    const mm = (pose: number) => figure(pose, 2, words);
    this.#honest.relabel("out", words.judge.honest.out(mm(out!.pose)));
    this.#honest.relabel("in", words.judge.honest.in(mm(left!.pose)));
  }

  #draw(): void {
    const { words } = this.#parts;
    this.#drawRows(this.#shown!.standing);
    const floors = this.#floors().map(([name, mm]) => words.judge.floor(name, figure(mm, 2, words)));
    setText(this.#readout, floors.length > 0 ? floors.join("; ") : words.judge.noTruth);
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
