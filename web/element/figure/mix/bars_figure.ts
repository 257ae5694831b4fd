/** The nearest classes at a frame: their distances, and the weights that these become. */
import { html, keepCount, setText } from "../../../ui/dom";
import { GuessField } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { figure } from "../words/words";
import sheet from "./mix.css?inline";
import { type ClassShare, measureMix, sharesOf } from "./mix_measure";
import { MIX_FIELDS, type MixState } from "./mix_state";

/** Classes that are shown. */
const SHOWN = 6;
/** Classes that the question is about. */
const ASKED = 2;

export const BARS: FigureKind<MixState> = {
  fields: MIX_FIELDS,
  sheet,
  create: (parts) => new BarsFigure(parts),
};

class BarsFigure implements FigureInstance<MixState> {
  readonly #parts: FigureParts<MixState>;
  readonly #rows = html("div", { class: "bars" });
  readonly #guess: GuessField;
  readonly #sharing = new Latest<MixState>((state) => this.#share(state));
  #state: MixState | undefined;
  #shares: ClassShare[] = [];

  constructor(parts: FigureParts<MixState>) {
    this.#parts = parts;
    const { words, container, change, signal } = parts;
    this.#guess = new GuessField(words.mix.guess, { min: 0, max: 1 }, -1, (guess) => change({ guess }, true), signal);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.mix.title)),
      html("div", { class: "picture listed" }, this.#rows),
      html("div", { class: "knobs" }, this.#guess.element),
    );
  }

  show(state: MixState): Promise<void> {
    this.#state = state;
    this.#guess.text = state.guess < 0 ? "" : figure(state.guess, 2, this.#parts.words);
    return this.#sharing.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureMix(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const { words } = this.#parts;
    const shown = this.#shares.slice(0, 3).map((one) => words.mix.class(...this.#said(one)));
    return shown.length > 0 ? words.mix.nearest(shown.join("; ")) : "";
  }

  table(): Table {
    return {
      head: this.#parts.words.mix.columns,
      rows: this.#shares.slice(0, SHOWN).map((one) => [...this.#said(one)]),
    };
  }

  values(): Readonly<Record<string, string>> {
    const { words } = this.#parts;
    const [first] = this.#shares;
    if (!first) return {};
    return {
      D: `${figure(first.square, 2, words)} cm²`,
      min: `${figure(first.square, 2, words)} cm²`,
      lambda: figure(first.weight, 2, words),
    };
  }

  light(term: string | undefined): void {
    for (const mark of this.#rows.querySelectorAll("[data-term]"))
      mark.classList.toggle("lit", mark.getAttribute("data-term") === term);
  }

  #said({ action, style, square, weight }: ClassShare): [name: string, square: string, weight: string] {
    const { words } = this.#parts;
    const styles: Readonly<Record<string, string>> = words.styles;
    const name = `${words.mix.actions[action] ?? action} / ${styles[style] ?? style}`;
    return [name, figure(square, 2, words), figure(weight, 2, words)];
  }

  async #share(state: MixState): Promise<void> {
    const shares = await sharesOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#shares = shares;
    this.#draw();
    this.#parts.changed();
  }

  #draw(): void {
    const shown = this.#shares.slice(0, SHOWN);
    const greatest = Math.max(...shown.map(({ square }) => square));
    keepCount(this.#rows, shown.length, () => row());
    shown.forEach((one, i) => {
      const element = this.#rows.children[i]!;
      const [name, square, weight] = this.#said(one);
      element.classList.toggle("asked", i < ASKED);
      setText(element.querySelector(".name")!, name);
      setText(element.querySelector(".square .number")!, `${square} cm²`);
      setText(element.querySelector(".weight .number")!, weight);
      element.querySelector<HTMLElement>(".square .bar")!.style.setProperty("--share", String(one.square / greatest));
      element.querySelector<HTMLElement>(".weight .bar")!.style.setProperty("--share", String(one.weight));
    });
  }
}

function row(): HTMLElement {
  const bar = (kind: string, term: string) =>
    html("span", { class: kind, "data-term": term }, html("i", { class: "bar" }), html("span", { class: "number" }));
  return html("div", { class: "class" }, html("span", { class: "name" }), bar("square", "D"), bar("weight", "lambda"));
}
