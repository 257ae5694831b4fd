/**
 * Returns messages about generated texts that are not up to date, and about untested code blocks. @param command path
 * of `strut`
 */
export function generatedFaults(command: string): Promise<string[]>;
