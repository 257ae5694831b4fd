/** What is wrong with the references of a text to the documents in `folder`, one sentence each. */
export function referenceFaults(text: string, folder: string): string[];
