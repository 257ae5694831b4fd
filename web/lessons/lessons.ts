/** The lessons that there are, in order: a lesson is a module, its texts, and a line here. Each is loaded when it is opened. */
import type { Lesson } from "./lesson";

/** Where a lesson is. */
export interface LessonEntry {
  id: string;
  load: () => Promise<Lesson>;
}

export const LESSONS: readonly LessonEntry[] = [
  { id: "style", load: async () => (await import("./style")).style },
  { id: "pose", load: async () => (await import("./pose")).pose },
  { id: "register", load: async () => (await import("./register")).register },
  { id: "near", load: async () => (await import("./near")).near },
  { id: "line", load: async () => (await import("./line")).line },
  { id: "mix", load: async () => (await import("./mix")).mix },
  { id: "bias", load: async () => (await import("./bias")).bias },
  { id: "time", load: async () => (await import("./time")).time },
  { id: "feet", load: async () => (await import("./feet")).feet },
  { id: "judge", load: async () => (await import("./judge")).judge },
  { id: "chain", load: async () => (await import("./chain")).chain },
  { id: "map", load: async () => (await import("./map")).map },
];

/** The lesson so many places after another; `undefined` beyond the ends. */
export function lessonBeside(id: string, by: number): LessonEntry | undefined {
  return LESSONS[LESSONS.indexOf(lessonOf(id)) + by];
}

/** The lesson of a name, or the first. */
export function lessonOf(id: string): LessonEntry {
  return LESSONS.find((lesson) => lesson.id === id) ?? LESSONS[0]!;
}
