/** Titles of the stage. */
import type { FieldVertex } from "../../../client/crowd/limits";
import type { CrowdKind } from "../../state/crowd";
import { strings } from "../../strings/strings";
import { capitalised, numberWord, spoken } from "../../ui/words";

const words = strings.crowd;

/** For example “Two hundred people, three ways of walking”. */
export function crowdTitle(kind: CrowdKind, count: number, field: readonly FieldVertex[]): string {
  const ways = new Set(field.map(({ style }) => style)).size;
  return words.title(words.people(count, capitalised(countWord(count))), words.of[kind].ways(ways, numberWord(ways)));
}

/** Description of the picture for screen readers. */
export function pictureOf(kind: CrowdKind, count: number, field: readonly FieldVertex[]): string {
  return words.picture(count, words.of[kind].does, [...new Set(field.map(({ style }) => spoken(style)))].join(", "));
}

/** Round numbers in words, others in digits. */
function countWord(count: number): string {
  if (count === 1000) return words.thousand;
  return count >= 100 && count % 100 === 0 ? words.hundreds(numberWord(count / 100)) : numberWord(count);
}
