/** Properties of the screen and of the user's settings. */

/**
 * Screens with the panels in one column: below 900 px at a text size of 16 px, and wider if text is larger. Style
 * sheets cannot import it: each has the same condition, which `media.test.ts` checks.
 */
export const NARROW = "(width < 56.25em)";

/** Whether the panels are in one column. */
export const isNarrow = (): boolean => matchMedia(NARROW).matches;

/** Whether the user prefers reduced motion. */
export const prefersReducedMotion = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** Whether the page runs as an installed app, in a window of its own. */
export const isInstalled = (): boolean => matchMedia("(display-mode: standalone), (display-mode: minimal-ui)").matches;

/** The user's text size as a multiple of the normal 16 px: the scale of drawings with text. */
export const textZoom = (): number => Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
