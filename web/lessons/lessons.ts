/** The lessons that there are, in order: a lesson is a module, its texts, and a line here. */
import type { Lesson } from "./lesson";
import { style } from "./style";

export const LESSONS: readonly Lesson[] = [style];

/** The lesson of a name, or the first. */
export function lessonOf(id: string): Lesson {
  return LESSONS.find((lesson) => lesson.id === id) ?? LESSONS[0]!;
}
