/** What the player says. Another language is a second table of the same type, and a choice here. */
import { element } from "./strings.en";

/** What a language has to say. */
export type ElementStrings = typeof element;

/** The present language. */
export const strings: ElementStrings = element;
