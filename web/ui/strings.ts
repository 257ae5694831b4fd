/**
 * Texts of the controls shared by page and element. Another language is a second table of the same type, and a
 * selection here.
 */
import { ui } from "./strings.en";

/** The table of a language. */
type UiStrings = typeof ui;

/** The current language. */
export const strings: UiStrings = ui;
