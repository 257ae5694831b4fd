/** What the page asks of the screen and of the person's settings. */

/**
 * Screens on which the panels stand in one column: below 900 px at a text size of 16 px, and wider where text is larger.
 * Style sheets cannot import it: each has the same condition, which `media.test.ts` checks.
 */
export const NARROW = "(width < 56.25em)";

/** Whether the panels stand in one column. */
export const isNarrow = (): boolean => matchMedia(NARROW).matches;

/** Whether the person asked for less motion. */
export const prefersReducedMotion = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** The person's text size as a multiple of the usual 16 px: by how much pictures that hold text are drawn larger. */
export const textZoom = (): number => Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
