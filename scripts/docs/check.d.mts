/** Links of the site's pages that lead nowhere, a sentence each. */
export function linkFaults(): string[];
/** Parts of the site that are larger than they may be, and all sizes in a sentence. */
export function sizes(): { faults: string[]; report: string };
