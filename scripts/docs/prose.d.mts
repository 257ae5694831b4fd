/** Returns the paragraphs of a text, without code and tables. */
export function paragraphsOf(markdown: string): { line: number; text: string }[];
/** Returns the sentences of a paragraph. */
export function sentencesOf(text: string): string[];
/** Returns the number of words. */
export function wordCount(sentence: string): number;
