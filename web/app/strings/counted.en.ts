import { grouped } from "./numerals";

/** Words for a number of things: “1 clip”, “1,200 clips”. @param one the noun in the singular */
export const counted = (one: string) => (n: number) => `${grouped(n)} ${n === 1 ? one : `${one}s`}`;
