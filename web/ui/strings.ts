/** What the controls that page and element share say. Another language is a second table of the same type, and a choice here. */
import { ui } from "./strings.en";

/** What a language has to say. */
export type UiStrings = typeof ui;

/** The present language. */
export const strings: UiStrings = ui;
