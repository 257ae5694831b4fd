import { expect, test } from "vitest";
import { History } from "./history";

/** A number with a history. */
function counted() {
  let value = 0;
  const history = new History<number>(
    () => value,
    (saved) => {
      value = saved;
    },
  );
  const set = (next: number) => {
    history.record(value);
    value = next;
  };
  return { history, set, get: () => value };
}

test("steps are undone and redone in order, and an edit forgets what was undone", () => {
  const { history, set, get } = counted();
  for (const n of [1, 2, 3]) set(n);
  history.undo();
  history.undo();
  expect(get()).toBe(1);
  history.redo();
  expect(get()).toBe(2);
  set(9);
  expect([history.canUndo, history.canRedo]).toEqual([true, false]);
  history.redo();
  expect(get()).toBe(9);
  history.undo();
  expect(get()).toBe(2);
});

test("a withdrawn step leaves the steps before it and what was undone as they were", () => {
  const { history, set, get } = counted();
  for (const n of [1, 2]) set(n);
  history.undo();
  set(9);
  history.withdraw();
  expect([get(), history.canUndo, history.canRedo]).toEqual([1, true, true]);
  history.withdraw();
  expect(get(), "only the last step is withdrawn").toBe(1);
  history.redo();
  expect(get()).toBe(2);
  history.undo();
  history.undo();
  expect([get(), history.canUndo]).toEqual([0, false]);
});

test("a step that pushed the oldest one out brings it back when it is withdrawn", () => {
  const { history, set, get } = counted();
  for (let n = 1; n <= 201; n++) set(n);
  history.withdraw();
  while (history.canUndo) history.undo();
  expect(get()).toBe(0);
});

test("the oldest steps give way, and all can be forgotten", () => {
  const { history, set, get } = counted();
  for (let n = 1; n <= 300; n++) set(n);
  while (history.canUndo) history.undo();
  expect(get()).toBe(100);
  history.forget();
  history.redo();
  expect(get()).toBe(100);
});
