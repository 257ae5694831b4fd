/**
 * Returns a message for each attribute in the code of a document that its element does not have. @param tables result
 * of `readTables()`
 */
export function elementFaults(markdown: string, file: string, tables: unknown): string[];
