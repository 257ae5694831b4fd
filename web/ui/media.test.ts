import { readdirSync, readFileSync } from "node:fs";
import { resolve } from "node:path";
import { expect, it } from "vitest";
import { NARROW } from "./media";

const WEB = resolve(import.meta.dirname, "..");

/** The screen widths in a style sheet's conditions. */
const widthsIn = (sheet: string): string[] =>
  [...readFileSync(resolve(WEB, sheet), "utf8").matchAll(/@media ([^{]*)\{/g)].flatMap(
    ([, condition]) => condition?.match(/\([^()]*width[^()]*\)/g) ?? [],
  );

/** Below this width the manual has no room for the contents of a page next to its text. */
const CONTENTS_HIDDEN = "(width < 73.75em)";
/** Below this width the page's top bar has room only for the icons of its buttons. */
const BAR_OF_ICONS = "(width < 68em)";
/** Below this width the top bar of a phone has no room for all words. */
const SMALL_PHONE = "(width < 22.5em)";

it("is narrow below one width only, in style sheets and in code", () => {
  const sheets = readdirSync(WEB, { recursive: true, encoding: "utf8" }).filter((file) => file.endsWith(".css"));
  const widths = new Set(sheets.flatMap(widthsIn));
  expect(widths).toEqual(new Set([NARROW, NARROW.replace("<", ">="), CONTENTS_HIDDEN, BAR_OF_ICONS, SMALL_PHONE]));
});
