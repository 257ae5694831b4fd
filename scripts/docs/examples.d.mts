/** Returns the lines of a file between `anchor NAME` and `end NAME`, without their common indentation. */
export function anchorOf(text: string, name: string): string | undefined;
/** Returns Markdown with up-to-date examples, and a message for each block that comes from none although it should. */
export function withExamples(markdown: string, file: string): { text: string; faults: string[] };
