/** Sentences about generated texts that are not as they should be, and about untested code blocks. @param command `strut` */
export function generatedFaults(command: string): Promise<string[]>;
