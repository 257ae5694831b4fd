/** Returns the code of a document: blocks with their languages, markup as `html`, inline code without a language. */
export function codesOf(markdown: string): { line: number; language: string | undefined; code: string }[];
