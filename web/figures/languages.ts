/** The available languages: another one is a table, and a line here. */

import { de } from "./words/de";
import { en } from "./words/en";
import type { Words } from "./words/words";

export const WORDS = { en, de } as const satisfies Record<string, Words>;

/** A language of figures and lessons. */
export type Language = keyof typeof WORDS;

/** The languages, the default first. */
export const LANGUAGES = Object.keys(WORDS) as Language[];
