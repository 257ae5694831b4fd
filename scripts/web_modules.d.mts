/** Returns the shipped TypeScript files below a folder, each with the files that it imports and their specifiers. */
export function webModules(folder: string): Map<string, Map<string, string>>;
/** Returns a message for each cycle among modules. */
export function importCircles(modules: Map<string, Map<string, string>>): string[];
