import { readdirSync, readFileSync } from "node:fs";
import { resolve } from "node:path";
import { expect, it } from "vitest";
import { NARROW } from "./media";

const APP = resolve(import.meta.dirname, "..");

it("is narrow below one width only, in style sheets and in code", () => {
  const sheets = readdirSync(APP, { recursive: true, encoding: "utf8" }).filter((file) => file.endsWith(".css"));
  const conditions = sheets.flatMap((sheet) =>
    [...readFileSync(resolve(APP, sheet), "utf8").matchAll(/@media ([^{]*width[^{]*?) *\{/g)].map(([, found]) => found),
  );
  expect(conditions.length).toBeGreaterThan(3);
  const wide = NARROW.replace("<", ">=");
  expect(new Set(conditions)).toEqual(new Set([NARROW, wide]));
});
