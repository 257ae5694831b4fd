/** The shipped TypeScript files below a folder, each with the files that it imports and how it names them. */
export function webModules(folder: string): Map<string, Map<string, string>>;
/** The circles among modules, a sentence each. */
export function importCircles(modules: Map<string, Map<string, string>>): string[];
