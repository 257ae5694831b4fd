/** One command as `strut reference` prints it. */
export interface Command {
  name: string;
  arguments: { long: string | null; short: string | null; possible_values: string[] }[];
}
/** Commands and options in the code of a document that do not exist, a sentence for each. */
export function commandFaults(markdown: string, file: string, commands: readonly Command[]): string[];
