/** The texts of controls and messages come from the tables `strings.en.ts`, so that they can be translated. */
import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";

const WEB = fileURLToPath(new URL("../../", import.meta.url));

/** A text in the code: the name of a control, a tooltip, a message. */
const LITERAL = [
  /\b(?:button|Toggle|Segment)\(\s*["'`][A-Za-z]/,
  /\b(?:"aria-label"|title|placeholder): ["'`][A-Za-z]/,
  /\bsetText\([^,()]+, ["'`][A-Za-z]/,
  /\btoasts\.(?:error|note|offer)\(\s*["'`][A-Za-z]/,
];

test("no control or message has its text in the code", () => {
  const files = ["app", "ui"].flatMap((folder) =>
    readdirSync(`${WEB}${folder}`, { recursive: true, encoding: "utf8" }).map((path) => `${folder}/${path}`),
  );
  const sources = files.filter((path) => path.endsWith(".ts") && !/(\.test|strings\.en)\.ts$/.test(path));
  expect(sources.length).toBeGreaterThan(100);
  const found = sources.filter((path) => {
    const text = readFileSync(`${WEB}${path}`, "utf8");
    return LITERAL.some((literal) => literal.test(text));
  });
  expect(found).toEqual([]);
});
