/** Texts of the player. Another language is a second table of the same type, and a selection here. */
import { element } from "./strings.en";

/** The table of a language. */
type ElementStrings = typeof element;

/** The current language. */
export const strings: ElementStrings = element;
