/** What a kind of figure is: one module each, and a row in `kinds.ts`. */
import type { LearnEngine } from "../../client/learn/protocol";
import type { Fields } from "../../link/fields";
import { namesOf, readHash, writeHash } from "../../link/hash";
import type { FigureStage } from "./figure_stage";
import type { Language } from "./languages";
import type { Words } from "./words/words";

/** Numbers and names that a figure shows, by name; exercises are judged by them. */
export type Measure = Readonly<Record<string, number | string>>;

/** What a figure shows, as a table. */
export interface Table {
  head: readonly string[];
  rows: readonly (readonly string[])[];
}

/** What a figure has of its element. */
export interface FigureParts<State> {
  /** Where it is drawn. */
  container: HTMLElement;
  engine: LearnEngine;
  language: Language;
  words: Words;
  /** A person changed the state; `settled` where the hand has let go. */
  change(patch: Partial<State>, settled: boolean): void;
  /** A mark with a term is pointed at, or none. */
  point(term: string | undefined): void;
  /** Other things are shown than before: values, sentence and table are read again. */
  changed(): void;
  /** Ends with the figure. */
  signal: AbortSignal;
}

/** One figure on the page. */
export interface FigureInstance<State> {
  /** Takes a state; resolves when it is shown. */
  show(state: State): Promise<void>;
  /** What exercises are judged by, in the present state. */
  measure(): Promise<Measure>;
  /** The figure in a sentence. */
  sentence(): string;
  table(): Table;
  /** Values with units of the symbols that it shows, by term. */
  values(): Readonly<Record<string, string>>;
  /** Lights the marks of a term, or none. */
  light(term: string | undefined): void;
  /** Its 3-D picture: it is drawn while anybody sees it, takes the theme, and ends with the figure. */
  readonly stage?: FigureStage;
  /** The theme has changed: colours that are not those of the style sheet are drawn anew. */
  repaint?(): void;
}

/** A kind of figure. */
export interface FigureKind<State> {
  /** Its state, and how a link says it. */
  fields: Fields<State>;
  /** Text of a style sheet for what no other kinds have. */
  sheet?: string;
  /** @throws where the browser cannot draw it */
  create(parts: FigureParts<State>): FigureInstance<State>;
}

/** What a figure whose state is text has of its element. */
export type TextParts = Omit<FigureParts<string>, "change"> & { change(state: string, settled: boolean): void };

/** A kind as its element sees it: the state is the text of a link, of which a figure changes its own fields alone. */
export interface TextKind {
  sheet: string | undefined;
  create(parts: TextParts): FigureInstance<string>;
}

/** Makes a kind whose state is text. */
export function textKind<State extends object>({ fields, sheet, create }: FigureKind<State>): TextKind {
  return {
    sheet,
    create: ({ change, ...parts }) => {
      let text = "";
      const made = create({
        ...parts,
        change: (patch, settled) => {
          text = withFields(text, fields, { ...readHash(fields, text), ...patch });
          change(text, settled);
        },
      });
      return {
        show: (given) => {
          text = given;
          return made.show(readHash(fields, text));
        },
        measure: () => made.measure(),
        sentence: () => made.sentence(),
        table: () => made.table(),
        values: () => made.values(),
        light: (term) => made.light(term),
        ...(made.stage && { stage: made.stage }),
        repaint: () => made.repaint?.(),
      };
    },
  };
}

/** A link's text with other values of some fields; what else it says stays. */
export function withFields<State>(text: string, fields: Fields<State>, state: State): string {
  const others = new URLSearchParams(text);
  for (const name of namesOf(fields)) others.delete(fields[name].key);
  return [writeHash(fields, state), others.toString()].filter((part) => part !== "").join("&");
}
