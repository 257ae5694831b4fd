/** Names for what is kept beside other things: none takes the name of another. */

/** The name, or where it is taken the name with the lowest free number from 2: “My clips 2”. */
export function freeName(name: string, taken: Iterable<string>): string {
  const names = new Set(taken);
  let found = name;
  for (let n = 2; names.has(found); n++) found = `${name} ${n}`;
  return found;
}
