/** Texts of figures in a language: English has all of them, `languages.ts` the others. */
import { formatNumber as plain } from "../../ui/dom";
import type { Translated } from "../../ui/translated";
import type { en } from "./en";

/** Texts of figures in a language. */
export type Words = Translated<typeof en>;

/** A number in a language. */
export function formatNumber(value: number, digits: number, { decimal }: Pick<Words, "decimal">): string {
  return Number.isFinite(value) ? plain(value, digits).replace(".", decimal) : "–";
}
