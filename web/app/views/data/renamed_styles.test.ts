import { expect, test } from "vitest";
import { renamedStyles } from "./renamed_styles";

const clips = (styles: Record<string, string>) => new Map(Object.entries(styles));

test("a style is renamed where all its clips have one other name", () => {
  const before = clips({ a: "old", b: "old", c: "neutral" });
  expect(renamedStyles(before, clips({ a: "ancient", b: "ancient", c: "neutral" }))).toEqual(clips({ old: "ancient" }));
  expect(renamedStyles(before, clips({ a: "ancient", c: "neutral" })), "one clip is gone").toEqual(
    clips({ old: "ancient" }),
  );
});

test("a style that was divided, joined to another, or has gone is not renamed", () => {
  const before = clips({ a: "old", b: "old", c: "neutral" });
  for (const now of [
    { a: "ancient", b: "weary", c: "neutral" },
    { a: "old", b: "ancient", c: "neutral" },
    { a: "neutral", b: "neutral", c: "neutral" },
    { c: "neutral" },
  ])
    expect(renamedStyles(before, clips(now as Record<string, string>))).toEqual(new Map());
});
