// Tests of the check of references to docs/methods/.
import { join } from "node:path";
import { expect, test } from "vitest";
import { referenceFaults } from "../../scripts/methods.mjs";

const faults = (text: string) => referenceFaults(text, join(import.meta.dirname, "..", "..", "docs", "methods"));

test("sections that there are lead somewhere", () => {
  expect(faults("//! Timing (`docs/methods/mar.md` §9).")).toEqual([]);
  expect(faults("//! Build (`docs/methods/mar.md` §2–§4 and §7), walks (`docs/methods/hsmm.md` §6c).")).toEqual([]);
});

test("sections and documents that there are not are named", () => {
  expect(faults("// `docs/methods/mar.md` §99")).toEqual(["docs/methods/mar.md has no §99"]);
  expect(faults("// `docs/methods/mar.md` §2–§40")).toEqual(["docs/methods/mar.md has no §40"]);
  expect(faults("// `docs/methods/hsmm.md` §6z")).toEqual(["docs/methods/hsmm.md has no §6z"]);
  expect(faults("// `docs/methods/none.md` §1")).toEqual(["docs/methods/none.md does not exist"]);
});

test("a reference broken by the end of a line is read whole", () => {
  expect(faults("/// as `docs/methods/mar.md`\n    /// §77 says")).toEqual(["docs/methods/mar.md has no §77"]);
});

test("a section of no document is no reference", () => {
  expect(faults("//! Timing (specification, §9).")).toHaveLength(1);
  expect(faults("/// as in the specification §4;")).toHaveLength(1);
});
