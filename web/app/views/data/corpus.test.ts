import { describe, expect, test } from "vitest";
import {
  applyLabels,
  applyRead,
  classTable,
  concerns,
  databaseName,
  likelyNeutral,
  obstacle,
  type Row,
  rowOf,
} from "./corpus";

const row = (action: string, style: string): Row => ({ ...rowOf({ path: "a", licence: "" }, 0), action, style });

describe("labels", () => {
  test("come from names, but what a person typed stays", () => {
    const rows = ["a", "b", "c"].map((path, i) => rowOf({ path, licence: "" }, i));
    Object.assign(rows[1]!, { action: "run", style: "old", edited: true });
    const found = { action: "walk", style: "proud", take: 3 };
    applyLabels(rows, [found, found, { reason: "Its name does not match." }]);
    expect(rows.map((r) => [r.action, r.style, r.take])).toEqual([
      ["walk", "proud", 3],
      ["run", "old", undefined],
      ["", "", undefined],
    ]);
    expect(rows.map((r) => obstacle(r, []))).toEqual(["", "", "Its name does not match."]);
  });

  test("are not enough where the file or its skeleton has a fault, until a person chose the joints", () => {
    const rows = [row("walk", "old"), { ...row("walk", "old"), index: 1 }];
    const skeleton = {
      joints: [],
      parents: new Int32Array(),
      roles: new Int32Array(),
      confidence: 0,
      fault: "No knee.",
      note: "",
    };
    const skeletons: Parameters<typeof applyRead>[1] = [];
    applyRead(rows, skeletons, {
      clips: [
        { index: 0, fault: "It is empty." },
        { index: 1, frames: 10, rateHz: 30, skeleton: 0 },
      ],
      skeletons: [skeleton],
    });
    expect(rows.map((r) => obstacle(r, skeletons))).toEqual(["It is empty.", "No knee."]);
    skeletons[0]!.chosen = new Int32Array(21);
    expect(obstacle(rows[1]!, skeletons)).toBe("");
  });
});

describe("the table of classes", () => {
  const table = classTable([row("walk", "old"), row("walk", "old"), row("walk", "sad"), row("run", "old")]);

  test("counts", () => {
    expect(table.actions).toEqual(["run", "walk"]);
    expect(table.styles).toEqual(["old", "sad"]);
    expect(["old", "sad"].map((style) => table.count("run", style))).toEqual([1, 0]);
  });

  test("says what will be lacking", () => {
    expect(concerns(table)).toEqual([
      "“sad” has only one clip. More clips give better results.",
      "“sad” has no “run”: it will be guessed from other actions.",
    ]);
    expect(concerns(classTable([row("walk", "old")]))).toEqual([
      "Only one style so far. Add a second one to mix with.",
    ]);
    const many = classTable(["a", "b", "c", "d", "e"].map((style) => row("walk", style)).concat(row("run", "a")));
    expect(concerns(many)).toContain("“b”, “c”, “d” and 1 more have no “run”: it will be guessed from other actions.");
  });
});

test("the neutral style is known by its name", () => {
  expect(likelyNeutral(["active", "Normal"])).toBe("Normal");
  expect(likelyNeutral(["active", "old"])).toBe("active");
  expect(likelyNeutral([])).toBe("");
});

test("a database is called like the folder or archive that it comes from", () => {
  expect(databaseName(["bandai-namco-2.zip/in/a.bvh"])).toBe("bandai-namco-2");
  expect(databaseName(["takes/a.bvh"])).toBe("takes");
  expect(databaseName(["a.bvh"])).toBe("My clips");
});
