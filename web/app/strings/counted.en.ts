import { grouped } from "./numerals";

/** Makes a noun one that is counted: it has an s unless there is one of it. */
export const counted = (one: string) => (n: number) => `${grouped(n)} ${n === 1 ? one : `${one}s`}`;
