/** The paragraphs of a text, without code and tables. */
export function paragraphsOf(markdown: string): { line: number; text: string }[];
/** Sentences of a paragraph. */
export function sentencesOf(text: string): string[];
/** Number of words. */
export function wordCount(sentence: string): number;
