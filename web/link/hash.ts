/** States as the text of a link. */
import type { Fields } from "./fields";

/** Names of the members of a state. */
export function namesOf<State>(fields: Fields<State>): (keyof State)[] {
  return Object.keys(fields) as (keyof State)[];
}

/** All fields at their defaults. */
export function initialOf<State>(fields: Fields<State>): State {
  return Object.fromEntries(namesOf(fields).map((name) => [name, fields[name].initial])) as State;
}

/** Writes the fields that differ from their defaults as `key=value&…`, readable and without the leading `#`. */
export function writeHash<State>(fields: Fields<State>, state: State): string {
  const encode = <K extends keyof State>(name: K): string => fields[name].encode(state[name]);
  const differs = <K extends keyof State>(name: K) => encode(name) !== fields[name].encode(fields[name].initial);
  const readable = (value: string) => encodeURIComponent(value).replace(/%2C/g, ",").replace(/%3A/g, ":");
  return namesOf(fields)
    .filter(differs)
    .map((name) => `${fields[name].key}=${readable(encode(name))}`)
    .join("&");
}

/** Reads what {@link writeHash} wrote. Unknown keys and invalid values are ignored, so that links of other versions open. */
export function readHash<State>(fields: Fields<State>, hash: string): State {
  const state = initialOf(fields);
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const read = <K extends keyof State>(name: K): void => {
    const value = given.get(fields[name].key);
    const decoded = value === null ? undefined : fields[name].decode(value);
    if (decoded !== undefined) state[name] = decoded;
  };
  for (const name of namesOf(fields)) read(name);
  return state;
}
