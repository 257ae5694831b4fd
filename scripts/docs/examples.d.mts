/** The lines of a file between `anchor NAME` and `end NAME`, without their common indentation. */
export function anchorOf(text: string, name: string): string | undefined;
/** Markdown with its examples as they are now, and a sentence for each block that comes from none although it should. */
export function withExamples(markdown: string, file: string): { text: string; faults: string[] };
