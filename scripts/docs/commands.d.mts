/** A command in the output of `strut reference`. */
export interface Command {
  name: string;
  arguments: { long: string | null; short: string | null; possible_values: string[] }[];
}
/** Returns a message for each command or option in the code of a document that does not exist. */
export function commandFaults(markdown: string, file: string, commands: readonly Command[]): string[];
