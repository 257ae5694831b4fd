import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { strings } from "../strings/strings";

test("the page says over the stage before its script comes what it says after, until there is a character", () => {
  const page = readFileSync(join(import.meta.dirname, "../index.html"), "utf8");
  const { title, caption } = strings.play.before;
  expect(page).toContain(`<h1 class="stage-title">${title}</h1>`);
  expect(page).toContain(`<p class="caption">${caption}</p>`);
});
