/**
 * Everything that the page says, in one table. English is complete; another language is a second table of the type
 * {@link Strings}, in modules like those of `en/`, and a choice here.
 */
import { compare } from "./en/compare";
import { data } from "./en/data";
import { keyStyle } from "./en/key_style";
import { page } from "./en/page";
import { play } from "./en/play";
import { walk } from "./en/walk";

const en = { page, play, compare, data, walk, keyStyle };

/** A text where English has one, and a sentence of the same parts where it has a function. */
type Said<T> = T extends string
  ? string
  : T extends (...parts: infer P) => string
    ? (...parts: P) => string
    : { readonly [K in keyof T]: Said<T[K]> };

/** What a language has to say. */
export type Strings = Said<typeof en>;

/** The present language. */
export const strings: Strings = en;
