/** Texts of the figures of the evaluation. */
import type { Honest, Method, Source } from "../judge/judge_state";

export interface JudgeWords {
  title: string;
  methods: string;
  names: Readonly<Record<Method, string>>;
  columns: Readonly<Record<"pose" | "acceleration" | "content", string>>;
  source: string;
  sources: Readonly<Record<Source, string>>;
  leaveIn: string;
  honestOne: string;
  /** With the error in mm, or empty if it is not known yet. */
  honest: Readonly<Record<Honest, (mm: string) => string>>;
  computing: string;
  where: (take: string, style: string, leftIn: boolean) => string;
  achieved: (where: string, method: string, pose: string, acceleration: string, content: string) => string;
  notMeasured: (where: string, method: string) => string;
  unchanged: string;
  otherTake: string;
  otherTakeRecorded: string;
  floor: (name: string, mm: string) => string;
  noTruth: string;
  duel: string;
  rival: string;
  error: string;
  pin: (method: string) => string;
  duelled: (secs: string, pick: string, mm: string, rival: string, rivalMm: string, more: string) => string;
  duelMeans: (pick: string, mm: string, rival: string, rivalMm: string, more: string) => string;
  corrections: string;
  correction: string;
  instants: string;
  counting: (done: string, of: string) => string;
  counted: (joint: string, of: string, within: string, degrees: string, typical: string) => string;
  binColumns: readonly [bin: string, count: string];
}
