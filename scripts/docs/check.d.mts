/** Returns a message for each broken link of the site's pages. */
export function linkFaults(): string[];
/** Returns the parts of the site that exceed their size, and a message with all sizes. */
export function sizes(): { faults: string[]; report: string };
