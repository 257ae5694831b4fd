/** The learner's progress in the lessons: stored in this browser if it allows that, and sent nowhere. */

/** Key in localStorage. */
export const STORAGE_KEY = "strut.learn.1";
/** Longest text of the learner, characters. */
const MAX_WORDS = 4000;
const MAX_TRIES = 9999;

/** Progress in one lesson. */
export interface LessonProgress {
  /** The option of the bet; empty if it was skipped, `undefined` until then. */
  bet: string | undefined;
  /** The answer to “Why?”. */
  words: string;
  /** Wrong answers by exercise. */
  tries: Readonly<Record<string, number>>;
  /** Exercises that were solved. */
  solved: readonly string[];
}

/** Progress by lesson. */
export type Progress = Readonly<Record<string, LessonProgress>>;

const NONE: LessonProgress = { bet: undefined, words: "", tries: {}, solved: [] };

/** Encodes progress. */
export function encodeProgress(progress: Progress): string {
  return JSON.stringify({ strut: "learn", version: 1, lessons: progress });
}

/** Decodes {@link encodeProgress}; `undefined` if it is something else. Invalid parts are left out. */
export function decodeProgress(text: string): Progress | undefined {
  let data: unknown;
  try {
    data = JSON.parse(text);
  } catch {
    return undefined;
  }
  const { strut, version, lessons } = recordOf(data);
  if (strut !== "learn" || version !== 1) return undefined;
  return Object.fromEntries(
    Object.entries(recordOf(lessons)).map(([id, lesson]) => {
      const { bet, words, tries, solved } = recordOf(lesson);
      const counts = Object.entries(recordOf(tries)).filter(
        (entry): entry is [string, number] => Number.isInteger(entry[1]) && Number(entry[1]) >= 0,
      );
      return [
        id,
        {
          bet: typeof bet === "string" ? bet : undefined,
          words: typeof words === "string" ? words.slice(0, MAX_WORDS) : "",
          tries: Object.fromEntries(counts.map(([exercise, n]) => [exercise, Math.min(n, MAX_TRIES)])),
          solved: Array.isArray(solved) ? solved.filter((exercise) => typeof exercise === "string") : [],
        },
      ];
    }),
  );
}

function recordOf(value: unknown): Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value) ? (value as Record<string, unknown>) : {};
}

/** The part of `localStorage` that is needed. */
export type Memory = Pick<Storage, "getItem" | "setItem" | "removeItem">;

/** Progress that is stored if the browser allows it, and otherwise kept as long as the page. */
export class ProgressStore {
  readonly #memory: () => Memory;
  #progress: Progress = {};
  /** The text from which {@link #progress} was read or as which it was written. */
  #text: string | null = null;
  /** Whether the last change was stored. */
  kept = true;

  constructor(memory: () => Memory = () => localStorage) {
    this.#memory = memory;
    this.#read();
  }

  /** Progress in a lesson, from this and other tabs. */
  of(lesson: string): LessonProgress {
    this.#read();
    return Object.hasOwn(this.#progress, lesson) ? this.#progress[lesson]! : NONE;
  }

  change(lesson: string, patch: Partial<LessonProgress>): void {
    const before = this.of(lesson);
    this.#keep({ ...this.#progress, [lesson]: { ...before, ...patch } });
  }

  /** All progress as a file's text. */
  export(): string {
    this.#read();
    return encodeProgress(this.#progress);
  }

  /** Replaces all progress by the text of a file. Returns whether it was valid. */
  import(text: string): boolean {
    const progress = decodeProgress(text);
    if (progress) this.#keep(progress);
    return progress !== undefined;
  }

  erase(): void {
    this.#progress = {};
    try {
      this.#memory().removeItem(STORAGE_KEY);
    } catch {
      this.kept = false;
    }
  }

  /** Reads what another tab may have written, unless this tab's last change could not be stored. */
  #read(): void {
    if (!this.kept) return;
    try {
      const text = this.#memory().getItem(STORAGE_KEY);
      if (text === this.#text) return;
      this.#text = text;
      this.#progress = (text === null ? undefined : decodeProgress(text)) ?? {};
    } catch {
      this.kept = false;
    }
  }

  #keep(progress: Progress): void {
    this.#progress = progress;
    try {
      const text = encodeProgress(progress);
      this.#memory().setItem(STORAGE_KEY, text);
      this.#text = text;
      this.kept = true;
    } catch {
      this.kept = false;
    }
  }
}
