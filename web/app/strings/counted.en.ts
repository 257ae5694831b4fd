import { grouped } from "./numerals";

/** A number with its noun: “1 clip”, “1,200 clips”. @param one the noun in the singular */
export const counted = (one: string) => (n: number) => `${grouped(n)} ${n === 1 ? one : `${one}s`}`;
