/** A comment as Markdown: what it says, then parameters, result and errors. */
export function describe(comment: string): string;
