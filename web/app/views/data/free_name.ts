/** Unique names. */

/** The name, or if it is in use the name with the lowest free number from 2: “My clips 2”. */
export function freeName(name: string, taken: Iterable<string>): string {
  const names = new Set(taken);
  let found = name;
  for (let n = 2; names.has(found); n++) found = `${name} ${n}`;
  return found;
}
