/** Text of a lesson. `[term: words]` are words that highlight a mark, and backticks enclose a file name. */
import type { Translated } from "../../ui/translated";
import type { learn } from "./en/learn";

/** Numbers and names formatted in a language, by the names of a measure. */
export type Said = Readonly<Record<string, string>>;

/** Text of an exercise. */
export interface ExerciseText {
  task: string;
  pass: (said: Said) => string;
  /** A sentence for each kind of near miss. */
  near: Readonly<Record<string, (said: Said) => string>>;
  /** The subject of the exercise, for a wrong answer. */
  refuse: (said: Said) => string;
  no: (said: Said) => string;
  /** First a thought, then what to highlight. */
  hints: readonly [string, string];
}

/** Text of a lesson. */
export interface LessonText {
  idea: readonly string[];
  bet: { question: string; options: Readonly<Record<string, string>>; reveal: (said: Said) => string };
  look: readonly string[];
  /** Meaning of each symbol, by term. */
  symbols: Readonly<Record<string, { symbol: string; name: string }>>;
  why: string;
  exercises: Readonly<Record<string, ExerciseText>>;
  sources: readonly string[];
}

/** The texts of the lessons by id, each loaded when it is opened. */
export type LessonTexts = Readonly<Record<string, () => Promise<LessonText>>>;

/** Texts around every lesson. */
export type LearnText = Translated<typeof learn>;
