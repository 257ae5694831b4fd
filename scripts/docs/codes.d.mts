/** The code of a document: blocks with their languages, markup as `html`, code between words without a language. */
export function codesOf(markdown: string): { line: number; language: string | undefined; code: string }[];
