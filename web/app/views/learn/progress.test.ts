import fc from "fast-check";
import { expect, test } from "vitest";
import { decodeProgress, encodeProgress, type Memory, ProgressStore, STORAGE_KEY } from "./progress";

function memory(): Memory & { kept: Map<string, string> } {
  const kept = new Map<string, string>();
  return {
    kept,
    getItem: (key) => kept.get(key) ?? null,
    setItem: (key, value) => void kept.set(key, value),
    removeItem: (key) => void kept.delete(key),
  };
}

test("progress is kept, exported, imported and erased", () => {
  const first = memory();
  const store = new ProgressStore(() => first);
  expect(store.of("style")).toEqual({ bet: undefined, words: "", tries: {}, solved: [] });
  store.change("style", { bet: "second", tries: { A: 2 } });
  store.change("style", { solved: ["A"] });
  const again = new ProgressStore(() => first);
  expect(again.of("style")).toEqual({ bet: "second", words: "", tries: { A: 2 }, solved: ["A"] });
  const second = memory();
  const other = new ProgressStore(() => second);
  expect(other.import(again.export())).toBe(true);
  expect(other.of("style").solved).toEqual(["A"]);
  again.erase();
  expect(again.of("style").bet).toBeUndefined();
  expect(first.kept.has(STORAGE_KEY)).toBe(false);
});

test("two tabs over one memory add to each other's progress", () => {
  const shared = memory();
  const [tab, other] = [new ProgressStore(() => shared), new ProgressStore(() => shared)];
  tab.change("style", { solved: ["A"] });
  other.change("line", { bet: "first" });
  expect(tab.of("line").bet).toBe("first");
  expect(other.of("style").solved).toEqual(["A"]);
  other.erase();
  expect(tab.of("style").solved).toEqual([]);
});

test("where storage is full or forbidden, progress lasts as long as the page, and the page says so", () => {
  const refuse = () => {
    throw new DOMException("no", "SecurityError");
  };
  const forbidden = new ProgressStore(refuse);
  expect(forbidden.kept).toBe(false);
  forbidden.change("style", { bet: "" });
  expect(forbidden.of("style").bet).toBe("");
  forbidden.erase();
  const full = new ProgressStore(() => ({ ...memory(), setItem: refuse }));
  expect(full.kept).toBe(true);
  full.change("style", { words: "x" });
  expect(full.kept).toBe(false);
  expect(full.of("style").words).toBe("x");
});

test("what is no progress is refused, and what is none in it left out", () => {
  for (const text of ["", "null", "[]", "{}", '{"strut":"learn","version":2}'])
    expect(decodeProgress(text)).toBeUndefined();
  const odd =
    '{"strut":"learn","version":1,"lessons":{"style":{"bet":7,"tries":{"A":-1,"B":2},"solved":["A",3]},"x":null}}';
  expect(decodeProgress(odd)).toEqual({
    style: { bet: undefined, words: "", tries: { B: 2 }, solved: ["A"] },
    x: { bet: undefined, words: "", tries: {}, solved: [] },
  });
  fc.assert(
    fc.property(fc.json(), (json) => {
      const read = decodeProgress(`{"strut":"learn","version":1,"lessons":${json}}`)!;
      expect(decodeProgress(encodeProgress(read))).toEqual(read);
    }),
  );
});
