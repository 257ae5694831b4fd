/** The lessons in order: a lesson is a module, its texts, and a line here. Each is loaded when it is opened. */
import type { LearnEngine } from "../client/learn/protocol";
import type { Lesson } from "./lesson";

/** Location of a lesson. */
export interface LessonEntry {
  id: string;
  load: () => Promise<Lesson>;
  /** Makes the engine open the data that its figures need first. */
  begin: (engine: LearnEngine) => Promise<unknown>;
}

const database = (engine: LearnEngine) => engine.database();
const walk = (engine: LearnEngine) => engine.walk({ neutral: 1 }, 1);
const keyStyles = (engine: LearnEngine) => engine.styleSamples();

export const LESSONS: readonly LessonEntry[] = [
  { id: "style", begin: database, load: async () => (await import("./style")).style },
  { id: "pose", begin: database, load: async () => (await import("./pose")).pose },
  { id: "register", begin: database, load: async () => (await import("./register")).register },
  { id: "near", begin: database, load: async () => (await import("./near")).near },
  { id: "line", begin: database, load: async () => (await import("./line")).line },
  { id: "mix", begin: database, load: async () => (await import("./mix")).mix },
  { id: "bias", begin: database, load: async () => (await import("./bias")).bias },
  { id: "time", begin: database, load: async () => (await import("./time")).time },
  { id: "feet", begin: database, load: async () => (await import("./feet")).feet },
  { id: "judge", begin: database, load: async () => (await import("./judge")).judge },
  { id: "chain", begin: walk, load: async () => (await import("./chain")).chain },
  { id: "map", begin: keyStyles, load: async () => (await import("./map")).map },
];

/** The lesson `by` places after another; `undefined` beyond the ends. */
export function lessonBeside(id: string, by: number): LessonEntry | undefined {
  return LESSONS[LESSONS.indexOf(lessonOf(id)) + by];
}

/** The lesson with an id, or the first. */
export function lessonOf(id: string): LessonEntry {
  return LESSONS.find((lesson) => lesson.id === id) ?? LESSONS[0]!;
}
