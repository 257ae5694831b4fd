/** What a lesson is: figures with their presets, a bet, and exercises that the engine's numbers judge. */
import type { LearnEngine } from "../client/learn/protocol";
import type { Measure } from "../element/figure/kind";
import { withFields } from "../element/figure/kind";
import type { KindName } from "../element/figure/kinds";
import type { Fields } from "../link/fields";
import { initialOf, readHash } from "../link/hash";

/** The parts of a lesson, in order. */
export const BEATS = ["idea", "bet", "look", "why", "exercises", "sources"] as const;
export type Beat = (typeof BEATS)[number];

/** A figure of a lesson. */
export interface LessonFigure {
  name: string;
  kind: KindName;
  /** The beats in which it is shown; before the reveal a figure must not give the answer to the bet away. */
  beats: readonly Beat[];
  /** The beats that explain its marks and what can be chosen: the others show neither. */
  explained: readonly Beat[];
  /** An exercise whose answer it would give away: it is shown once that is solved. */
  after?: string;
}

/** A question that a figure answers: measured, never stored. */
export interface Exercise<State> {
  id: string;
  /** The figure whose measure judges it. */
  figure: string;
  /** What is set when the exercise begins; all else stays as it is. */
  start: Partial<State>;
  pass(measure: Measure): boolean;
  /** Which sentence helps somebody who is close, or who looks at something else than the task names. */
  near(measure: Measure): string | undefined;
  /** Whether it is the mistake that the exercise is about. */
  refuse(measure: Measure): boolean;
  /** A state that passes, found by trying. */
  solve(engine: LearnEngine): Promise<Partial<State>>;
}

/** A bet that is placed before its answer is shown. */
export interface Bet {
  options: readonly string[];
  /** The answer, and the numbers that it is read from. */
  reveal(engine: LearnEngine): Promise<{ answer: string; measure: Measure }>;
}

/** A lesson with the state of its figures. */
export interface LessonOf<State> {
  id: string;
  fields: Fields<State>;
  figures: readonly LessonFigure[];
  /** Markup of the equation. */
  equation: string;
  /** Terms of its symbols, in the order of the buttons. */
  symbols: readonly string[];
  bet: Bet;
  exercises: readonly Exercise<State>[];
  /** Decimals in sentences of measures that have others than two, by name. */
  decimals?: Readonly<Record<string, number>>;
}

/** A lesson as the view has it: states are the texts of links. */
export interface Lesson extends Omit<LessonOf<never>, "fields" | "exercises"> {
  /** A state with all that is unknown or out of range left out. */
  clean(state: string): string;
  /** Keys of the state in links. */
  keys: readonly string[];
  exercises: readonly TextExercise[];
}

/** An exercise whose states are the texts of links. */
export interface TextExercise extends Omit<Exercise<never>, "start" | "solve"> {
  start(state: string): string;
  solve(engine: LearnEngine): Promise<string>;
}

/** Makes a lesson whose states are text. */
export function lesson<State extends object>({ fields, exercises, ...rest }: LessonOf<State>): Lesson {
  const changed = (state: string, patch: Partial<State>) =>
    withFields("", fields, { ...readHash(fields, state), ...patch });
  return {
    ...rest,
    clean: (state) => changed(state, {}),
    keys: (Object.keys(initialOf(fields)) as (keyof State)[]).map((name) => fields[name].key),
    exercises: exercises.map(({ start, solve, ...exercise }) => ({
      ...exercise,
      start: (state) => changed(state, start),
      solve: async (engine) => changed("", { ...start, ...(await solve(engine)) }),
    })),
  };
}

/** How an answer is judged. */
export type Verdict = { result: "pass" | "refuse" | "no" } | { result: "near"; way: string };

/** Judges a measure. */
export function judge(exercise: Pick<TextExercise, "pass" | "near" | "refuse">, measure: Measure): Verdict {
  if (exercise.pass(measure)) return { result: "pass" };
  if (exercise.refuse(measure)) return { result: "refuse" };
  const way = exercise.near(measure);
  return way === undefined ? { result: "no" } : { result: "near", way };
}
