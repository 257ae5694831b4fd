/** The folder of the documentation site. */
export const OUT: string;
/** Writes the site and returns how many pages it has. */
export function writeDocs(): Promise<string>;
