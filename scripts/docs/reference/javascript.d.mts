/** Returns a comment as Markdown: the description, then parameters, result and errors. */
export function describe(comment: string): string;
