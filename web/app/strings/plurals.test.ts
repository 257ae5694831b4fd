import { expect, test } from "vitest";
import { batchWords } from "../batch/strings.en";
import { projectWords } from "../project/strings.en";
import { driveWords } from "../views/play/drive/strings.en";
import { strings } from "./strings";

/** Every sentence of a table with all arguments 1; functions with other arguments are skipped. */
function sentences(table: unknown, path: string): [string, string][] {
  if (typeof table === "function") {
    try {
      return [[path, String(table(...Array<number>(table.length).fill(1)))]];
    } catch {
      return [];
    }
  }
  if (typeof table !== "object" || table === null) return [];
  return Object.entries(table).flatMap(([name, member]) => sentences(member, `${path}.${name}`));
}

const COUNTED =
  "styles|clips|frames|files|motions|steps|keys|joints|components|people|performers|remarks|folders|guesses";

/** Quantities that are never 1: lengths of motions, limits, and texts about several items only. */
const NEVER_ONE = [
  "compare.captions.knn",
  "data.build.ready",
  "keyStyle.tooManyKeys",
  "page.manner.mix",
  "projectWords.tooMany",
  "walk.cadenceFigure",
];

test("one is counted in the singular", () => {
  const wrong = Object.entries({ ...strings, batchWords, projectWords, driveWords })
    .flatMap(([name, table]) => sentences(table, name))
    .filter(([path]) => !NEVER_ONE.includes(path))
    .filter(([, sentence]) => new RegExp(`\\b1 (\\w+ )?(${COUNTED})\\b`).test(sentence));
  expect(wrong).toEqual([]);
});
