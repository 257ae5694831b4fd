/** URL of the playground, to which players link. */

/** Replaced by `STRUT_SITE_URL` when the package is built. */
declare const STRUT_SITE: string;

/** The URL; empty if it is not known. */
export const SITE = STRUT_SITE;
