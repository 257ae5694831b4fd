/** State of the Learn view: the position in the lessons, and the state of the figures. */
import { type Fields, flag, number, text } from "../../link/fields";

export interface LearnState {
  /** Id of the lesson; an unknown id means the first lesson. */
  lesson: string;
  /** Index of the part of the lesson. */
  beat: number;
  /** Id of the current exercise: a link with an exercise is checked when it is opened. */
  task: string;
  /** Language of the lessons. */
  language: string;
  /** Whether the lesson is presented: large type, and arrow keys turn pages. */
  present: boolean;
  /** Hidden parts, comma-separated: `text`, `controls`, `answers`. */
  hide: string;
  /** State of the lesson's figures as the text of a link. Its keys are in the page's link, together with the others. */
  figures: string;
}

/** Range of the parts of a lesson, `web/lessons/lesson.ts`. */
const BEATS = { min: 0, max: 5, digits: 0 };
/** A longer text is not a state of figures. */
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
