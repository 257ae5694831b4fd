import { expect, test } from "vitest";
import { rowOf } from "./corpus";
import { Edits } from "./edits";

test("an edit is taken back and done again, and a new one forgets what was taken back", () => {
  let changes = 0;
  const row = { ...rowOf({ path: "a", licence: "" }, 0), unlabelled: "Its name does not match." };
  const edits = new Edits({ rows: [row], neutral: "", chosen: new Map() }, () => changes++);
  edits.edit([row], { action: "walk" });
  edits.edit([row], { style: "old", take: 3 });
  expect(row).toMatchObject({ action: "walk", style: "old", take: 3, edited: true, unlabelled: "" });
  edits.undo();
  expect(row).toMatchObject({ action: "walk", style: "", take: undefined });
  edits.undo();
  expect(row).toMatchObject({ action: "", edited: false, unlabelled: "Its name does not match." });
  expect([edits.canUndo, edits.canRedo]).toEqual([false, true]);
  edits.redo();
  edits.edit([row], { action: "run" });
  expect([edits.canUndo, edits.canRedo, row.action]).toEqual([true, false, "run"]);
  expect(changes).toBe(6);
  edits.forget();
  edits.undo();
  expect(row.action).toBe("run");
});

test("many rows are edited, and taken back, at once", () => {
  const rows = ["old", "aged"].map((style, i) => ({ ...rowOf({ path: String(i), licence: "" }, i), style }));
  const edits = new Edits({ rows, neutral: "", chosen: new Map() }, () => {});
  edits.edit(rows, { style: "elderly" });
  expect(rows.map((row) => row.style)).toEqual(["elderly", "elderly"]);
  edits.undo();
  expect(rows.map((row) => row.style)).toEqual(["old", "aged"]);
  expect(edits.canUndo).toBe(false);
});
