/** The interface of a lesson: figures with their presets, a bet, and exercises judged by the engine's numbers. */
import type { LearnEngine } from "../client/learn/protocol";
import type { Measure } from "../figures/kind";
import { withFields } from "../figures/kind";
import type { KindName } from "../figures/kinds";
import type { Fields } from "../link/fields";
import { initialOf, readHash } from "../link/hash";

/** The parts of a lesson, in order. */
export const BEATS = ["idea", "bet", "look", "why", "exercises", "sources"] as const;
export type Beat = (typeof BEATS)[number];

/** A figure of a lesson. */
interface LessonFigure {
  name: string;
  kind: KindName;
  /** The beats in which it is shown, all by default; before the reveal a figure must not reveal the answer to the bet. */
  beats?: readonly Beat[];
  /**
   * The beats that explain its marks and choices; the others show neither. By default all of its beats, or those after
   * the bet if it is shown there.
   */
  explained?: readonly Beat[];
  /** An exercise whose answer it would reveal: it is shown once that is solved. */
  after?: string;
}

/** A question that a figure answers: measured, never stored. */
export interface Exercise<State> {
  id: string;
  /** The figure whose measure judges it. */
  figure: string;
  /** Values set at the start of the exercise; the rest is unchanged. */
  start: Partial<State>;
  pass(measure: Measure): boolean;
  /** Key of the sentence for a near miss, or for a state other than the task's. */
  near(measure: Measure): string | undefined;
  /** Whether it is the misconception of the exercise. */
  refuse(measure: Measure): boolean;
  /** Finds a state that passes, by search. */
  solve(engine: LearnEngine): Promise<Partial<State>>;
}

/** A bet that is placed before its answer is shown. */
interface Bet {
  options: readonly string[];
  /** The answer, and the numbers from which it is derived. */
  reveal(engine: LearnEngine): Promise<{ answer: string; measure: Measure }>;
}

/** A lesson with the state of its figures. */
interface LessonOf<State> {
  id: string;
  fields: Fields<State>;
  figures: readonly LessonFigure[];
  /** Markup of the equation. */
  equation: string;
  /** Terms of its symbols, in the order of the buttons. */
  symbols: readonly string[];
  bet: Bet;
  exercises: readonly Exercise<State>[];
  /** Number of decimals in sentences by measure, where it is not two. */
  decimals?: Readonly<Record<string, number>>;
}

/** A lesson for the view: states are the texts of links. */
export interface Lesson extends Omit<LessonOf<never>, "fields" | "figures" | "exercises"> {
  figures: readonly (LessonFigure & Required<Pick<LessonFigure, "beats" | "explained">>)[];
  /** A state without unknown or invalid values. */
  clean(state: string): string;
  /** Keys of the state in links. */
  keys: readonly string[];
  exercises: readonly TextExercise[];
}

/** An exercise whose states are the texts of links. */
interface TextExercise extends Omit<Exercise<never>, "start" | "solve"> {
  start(state: string): string;
  solve(engine: LearnEngine): Promise<string>;
}

/** Converts a lesson to one whose states are text. */
export function lesson<State extends object>({ fields, figures, exercises, ...rest }: LessonOf<State>): Lesson {
  const changed = (state: string, patch: Partial<State>) =>
    withFields("", fields, { ...readHash(fields, state), ...patch });
  return {
    ...rest,
    figures: figures.map(({ beats = BEATS, explained = explainedOf(beats), ...figure }) => ({
      ...figure,
      beats,
      explained,
    })),
    clean: (state) => changed(state, {}),
    keys: (Object.keys(initialOf(fields)) as (keyof State)[]).map((name) => fields[name].key),
    exercises: exercises.map(({ start, solve, ...exercise }) => ({
      ...exercise,
      start: (state) => changed(state, start),
      solve: async (engine) => changed("", { ...start, ...(await solve(engine)) }),
    })),
  };
}

/** The beats that explain a figure, by default. */
function explainedOf(beats: readonly Beat[]): readonly Beat[] {
  return beats.includes("bet") ? beats.filter((beat) => BEATS.indexOf(beat) > BEATS.indexOf("bet")) : beats;
}

/** The result of an answer. */
export type Verdict = { result: "pass" | "refuse" | "no" } | { result: "near"; way: string };

/** Judges a measure. */
export function judge(exercise: Pick<TextExercise, "pass" | "near" | "refuse">, measure: Measure): Verdict {
  if (exercise.pass(measure)) return { result: "pass" };
  if (exercise.refuse(measure)) return { result: "refuse" };
  const way = exercise.near(measure);
  return way === undefined ? { result: "no" } : { result: "near", way };
}
