/** The interface of a kind of figure: one module each, and a row in `kinds.ts`. */
import type { LearnEngine } from "../client/learn/protocol";
import type { Fields } from "../link/fields";
import { namesOf, readHash, writeHash } from "../link/hash";
import type { FigureStage } from "./figure_stage";
import type { Language } from "./languages";
import type { Words } from "./words/words";

/** Numbers and names that a figure displays, by name; exercises are judged by them. */
export type Measure = Readonly<Record<string, number | string>>;

/** The contents of a figure as a table. */
export interface Table {
  head: readonly string[];
  rows: readonly (readonly string[])[];
}

/** The element's interface for a figure. */
export interface FigureParts<State> {
  /** The element in which it is drawn. */
  container: HTMLElement;
  engine: LearnEngine;
  /** The members of the state, with their defaults. */
  fields: Fields<State>;
  language: Language;
  words: Words;
  /** Called when the user changed the state; `settled` when the drag has ended. */
  change(patch: Partial<State>, settled: boolean): void;
  /** Called when a mark with a term is hovered, or none. */
  point(term: string | undefined): void;
  /** Called when the displayed contents change: values, sentence and table are read again. */
  changed(): void;
  /** Aborts with the figure. */
  signal: AbortSignal;
}

/** One figure on the page. */
export interface FigureInstance<State> {
  /** Sets a state. Resolves when it is displayed. */
  show(state: State): Promise<void>;
  /** A sentence describing the figure. */
  sentence(): string;
  table(): Table;
  /** Values with units of the displayed symbols, by term. */
  values(): Readonly<Record<string, string>>;
  /** Highlights the marks of a term, or none. */
  light(term: string | undefined): void;
  /** Its 3-D picture: drawn while visible, with the page's theme, and disposed of with the figure. */
  readonly stage?: FigureStage;
  /** Called when the theme has changed: colours outside the style sheet must be drawn again. */
  repaint?(): void;
}

/** A kind of figure. */
export interface FigureKind<State> {
  /** Its state, and the encoding in a link. */
  fields: Fields<State>;
  /** The measures for the exercises in a state. */
  measure(engine: LearnEngine, state: State): Promise<Measure>;
  /** Style sheet text that only this kind needs. */
  sheet?: string;
  /** @throws if the browser cannot draw it */
  create(parts: FigureParts<State>): FigureInstance<State>;
}

/** The element's interface for a figure whose state is text. */
type TextParts = Omit<FigureParts<string>, "change" | "fields"> & {
  change(state: string, settled: boolean): void;
};

/** A figure whose state is text. */
export interface TextFigure extends FigureInstance<string> {
  /** The measures for the exercises, in the current state. */
  measure(): Promise<Measure>;
}

/** A kind as its element sees it: the state is the text of a link, of which a figure changes only its own fields. */
export interface TextKind {
  sheet: string | undefined;
  create(parts: TextParts): TextFigure;
}

/** Converts a kind to one whose state is text. */
export function textKind<State extends object>({ fields, measure, sheet, create }: FigureKind<State>): TextKind {
  return {
    sheet,
    create: ({ change, ...parts }) => {
      let text = "";
      const made = create({
        ...parts,
        fields,
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
        measure: () => measure(parts.engine, readHash(fields, text)),
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

/** A link's text with changed values of some fields; the rest is unchanged. */
export function withFields<State>(text: string, fields: Fields<State>, state: State): string {
  const others = new URLSearchParams(text);
  for (const name of namesOf(fields)) others.delete(fields[name].key);
  return [writeHash(fields, state), others.toString()].filter((part) => part !== "").join("&");
}
