/** State of the Learn view: where one is in the lessons, and what the figures show. */
import { type Fields, flag, number, text } from "../../link/fields";

export interface LearnState {
  /** Id of the lesson; the first where there is none of the id. */
  lesson: string;
  /** Number of the part of the lesson. */
  beat: number;
  /** Id of the exercise under way: a link that has one is checked when it is opened. */
  task: string;
  /** Language of the lessons. */
  language: string;
  /** Whether the lesson is presented: large type, arrow keys turn over. */
  present: boolean;
  /** What is not shown, with commas: `text`, `controls`, `answers`. */
  hide: string;
  /** State of the lesson's figures as the text of a link. Its keys stand in the page's link beside the others. */
  figures: string;
}

/** Parts of a lesson, `web/lessons/lesson.ts`. */
const BEATS = { min: 0, max: 5, digits: 0 };
/** A longer text is no state of figures. */
const MAX_LENGTH = 2000;

export const LEARN_FIELDS: Fields<LearnState> = {
  lesson: text("lesson", "style", false),
  beat: number("beat", 0, BEATS, false),
  task: text("task", "", false),
  language: text("lang", "en", false),
  present: flag("present", false, false),
  hide: text("hide", "", false),
  // Never written under this key: see `toHash`.
  figures: text("figures", "", true),
};

/** The pairs of a link whose keys are not among those given. */
export function foreignPairs(hash: string, known: ReadonlySet<string>): string {
  const pairs = new URLSearchParams(hash.replace(/^#/, ""));
  for (const key of [...pairs.keys()]) if (known.has(key)) pairs.delete(key);
  const text = pairs.toString();
  return text.length <= MAX_LENGTH ? text : "";
}
