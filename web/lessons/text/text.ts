/** Text of a lesson. `[term: words]` are words that highlight a mark, and backticks enclose a file name. */
import type { Beat } from "../lesson";

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
export interface LearnText {
  /** Goal of each lesson, by its id. */
  titles: Readonly<Record<string, string>>;
  lesson: string;
  lessonOf: (n: number, of: number) => string;
  beats: Readonly<Record<Beat, string>>;
  parts: string;
  previous: string;
  next: string;
  language: string;
  languageName: string;
  place: string;
  skip: string;
  locked: string;
  right: string;
  wrong: string;
  skipped: string;
  symbols: string;
  equation: string;
  yourWords: string;
  keptHere: string;
  notKept: string;
  begin: string;
  working: string;
  hint: (n: number) => string;
  solution: string;
  linkToAnswer: string;
  copied: string;
  notCopied: string;
  solved: string;
  tries: (n: number) => string;
  progress: string;
  exportProgress: string;
  importProgress: string;
  eraseProgress: string;
  eraseQuestion: string;
  erased: string;
  imported: string;
  notImported: string;
  present: string;
  leavePresent: string;
  print: string;
  resetFigures: string;
  linkToFigure: string;
  figures: string;
  figure: string;
  embed: string;
  frame: string;
  element: string;
  code: string;
  copy: string;
  codeCopied: string;
  copyByHand: string;
  close: string;
  failed: (why: string) => string;
}
