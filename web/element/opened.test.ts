import { beforeEach, expect, it, vi } from "vitest";
import type { Cast } from "./cast";
import type { FigureListeners } from "./figure";
import { openFigure, type Wanted } from "./opened";

/** What is open now. */
const held = vi.hoisted(() => new Set<string>());
/** Whether the figure's character can be shown. */
const character = vi.hoisted(() => ({ compiles: true }));

vi.mock("./figure", () => ({
  Figure: class {
    static async open() {
      held.add("figure");
      return new this();
    }
    async perform() {
      if (!character.compiles) throw new Error("The materials do not compile.");
    }
    dispose() {
      held.delete("figure");
    }
  },
}));

vi.mock("./host", () => {
  const lease = async (kind: string) => {
    held.add(kind);
    return { value: {}, release: () => held.delete(kind) };
  };
  return {
    sharedEngine: () => ({ database: () => lease("database"), motion: () => lease("motion"), strut: async () => ({}) }),
    screens: {
      lease: () => {
        held.add("screen");
        return { value: {}, release: () => held.delete("screen") };
      },
    },
    schedule: { add() {}, remove() {} },
  };
});

vi.mock("../ui/dom", () => ({
  html: () => {
    held.add("picture");
    return { remove: () => held.delete("picture") };
  },
}));

beforeEach(() => held.clear());

const open = () =>
  openFigure(
    { motion: "strut:walk", reading: undefined, database: "strut:walk", character: undefined } as unknown as Wanted,
    {
      cast: { take: async () => {}, character: undefined } as unknown as Cast,
      picture: { append() {} } as unknown as HTMLElement,
      listeners: {} as FigureListeners,
    },
    {},
  );

it("a figure that is opened holds what it needs", async () => {
  character.compiles = true;
  await open();
  expect([...held].sort()).toEqual(["database", "figure", "motion", "picture", "screen"]);
});

it("a figure whose character cannot be shown leaves nothing open", async () => {
  character.compiles = false;
  await expect(open()).rejects.toThrow("do not compile");
  expect([...held]).toEqual([]);
});
