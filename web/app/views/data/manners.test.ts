import { describe, expect, test } from "vitest";
import { type Row, rowOf } from "./corpus";
import { clipsInWords, mannersAmong } from "./manners";

const clip = (path: string, take?: number): Row => ({
  ...rowOf({ path, licence: "" }, 0),
  action: "turn",
  style: "weary",
  take,
});
const found = [
  {
    action: "turn",
    style: "weary",
    paths: [
      ["a", "b"],
      ["c", "d"],
    ] as [string[], string[]],
  },
];

describe("what a build found", () => {
  test("is named by the clips' labels as they are now", () => {
    const rows = ["a", "b", "c", "d", "e"].map((path) => clip(path));
    for (const row of rows) row.style = "tired";
    const [a, b, c, d] = rows as [Row, Row, Row, Row, Row];
    expect(mannersAmong(rows, found)).toEqual([
      {
        action: "turn",
        style: "tired",
        rows: [
          [a, b],
          [c, d],
        ],
      },
    ]);
  });

  test("no longer holds once the manners are styles of their own, or a clip is gone", () => {
    const rows = ["a", "b", "c", "d"].map((path) => clip(path));
    rows[3]!.style = "weary 2";
    expect(mannersAmong(rows, found)).toEqual([]);
    expect(
      mannersAmong(
        ["a", "b", "c"].map((path) => clip(path)),
        found,
      ),
    ).toEqual([]);
    expect(mannersAmong([], found)).toEqual([]);
  });
});

test("clips are named by their takes, or by their files where takes do not tell them apart", () => {
  expect(clipsInWords([6, 1, 2, 3].map((take) => clip("a", take)))).toBe("takes 1–3, 6");
  expect(clipsInWords([clip("in/a.bvh", 1), clip("in/b.bvh", 1)])).toBe("a.bvh, b.bvh");
  expect(clipsInWords([clip("a.bvh"), clip("b.bvh", 1)])).toBe("a.bvh, b.bvh");
});
