/** Attributes in the code of a document that its elements do not have, a sentence for each. @param tables of `readTables()` */
export function elementFaults(markdown: string, file: string, tables: unknown): string[];
