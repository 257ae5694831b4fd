/** Documents describe `<strut-player>` as its tables do. */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { attributeTableOf, readTables } from "../../scripts/element_manifest.mjs";
import { root } from "../recordings";

test("docs/embedding.md has the attributes", async () => {
  const document = readFileSync(join(root, "docs", "embedding.md"), "utf8");
  expect(document).toContain(attributeTableOf(await readTables()));
});
