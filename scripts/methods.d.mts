/** Returns a message for each broken reference of a text to the documents in `folder`. */
export function referenceFaults(text: string, folder: string): string[];
