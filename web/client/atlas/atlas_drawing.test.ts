/** Drawing of an atlas on the GPU or the CPU, with the real engine. */
import { afterEach, beforeEach, describe, expect, it } from "vitest";
import { InlineWorker } from "../../../tests/inline_worker";
import { StrutError } from "../../engine/errors";
import { EngineClient } from "../engine_client";
import { AtlasDrawing, type Columns, Losses } from "./atlas_drawing";
import type { AtlasView, ClientAtlas, PackedWindows } from "./client_atlas";
import type { Graphics } from "./graphics";

const FOUND = { name: "a graphics card" };
const COLUMNS = 20;
const never = new AbortController().signal;
const lost = () => new StrutError({ code: "gpu-lost", message: "It stopped.", hint: "" });

let engine: EngineClient;
let atlas: ClientAtlas;
let view: AtlasView;

beforeEach(async () => {
  engine = new EngineClient({ spawn: () => new InlineWorker() });
  const database = await engine.openDatabase({ kind: "demo", set: "first" });
  const motion = await engine.openMotion({ kind: "built-in", name: "neutral walk", set: "first" });
  atlas = await engine.openAtlas(database, motion, COLUMNS);
  view = { part: "whole", first: 0, last: atlas.firsts.at(-1)!, height: 30 };
});
afterEach(() => engine.dispose());

/** The finished picture, and the columns in the order in which they arrived. */
async function drawn(drawing: AtlasDrawing, of = view) {
  const picture = new Float32Array(COLUMNS * of.height).fill(Number.NaN);
  const order: number[] = [];
  const take = ({ columns, distances }: Columns) => {
    for (const [i, column] of columns.entries()) {
      order.push(column);
      picture.set(distances.subarray(i * of.height, (i + 1) * of.height), column * of.height);
    }
  };
  return { ...(await drawing.draw(of, take, never)), picture, order };
}

/** A fake GPU that is lost after `columns` columns; it draws 1 everywhere. */
const stoppingAfter = (columns: number) =>
  ({
    setLines: async () => {},
    draw: async ({ windows }: PackedWindows, onColumns: (first: number, distances: Float32Array) => void) => {
      const count = Math.min(columns, windows.length / 12);
      onColumns(0, new Float32Array(count * view.height).fill(1));
      if (count < windows.length / 12) throw lost();
    },
    dispose: () => {},
  }) as unknown as Graphics;

describe("the processor", () => {
  it("draws every eighth column first, and all of them once", async () => {
    const { by, without, order, picture } = await drawn(new AtlasDrawing(atlas, undefined));
    expect({ by, without }).toEqual({ by: undefined, without: "absent" });
    expect(order.slice(0, 3)).toEqual([0, 8, 16]);
    expect(order.toSorted((a, b) => a - b)).toEqual(Array.from({ length: COLUMNS }, (_, i) => i));
    expect(picture.every((square) => square >= 0 && square < 10)).toBe(true);
  });

  it("finds the same where it is asked about one line", async () => {
    for (const part of ["whole", "legs", "head"] as const) {
      const { picture } = await drawn(new AtlasDrawing(atlas, undefined), { ...view, part });
      const { distance, name, window, clip, frame } = await atlas.nearest({ ...view, part }, 7, 11);
      expect(distance ** 2).toBeCloseTo(picture[7 * view.height + 11]!, 6);
      expect(name).not.toBe("");
      expect(window).toBeGreaterThanOrEqual(Math.floor((11 / 30) * view.last));
      expect((await atlas.pose(7, clip, frame)).every(Number.isFinite)).toBe(true);
    }
  });

  it("stops where its caller has another wish", async () => {
    const busy = new AbortController();
    const drawing = new AtlasDrawing(atlas, undefined).draw(view, () => busy.abort(), busy.signal);
    await expect(drawing).rejects.toMatchObject({ code: "cancelled" });
    await expect(atlas.nearest(view, COLUMNS, 0)).rejects.toMatchObject({ code: "bad-input" });
    await expect(atlas.pose(0, 0, 0)).rejects.toMatchObject({ code: "bad-input" });
  });
});

describe("the graphics processor", () => {
  it("gets the windows, their lines and the columns in whole tiles", async () => {
    const packed = await atlas.packed(view);
    const lines = await atlas.lines(view);
    expect(packed.windows.length % (32 * 12)).toBe(0);
    expect(lines).toHaveLength(packed.windows.length / 12);
    expect(lines.filter((line) => line < view.height)).toHaveLength(view.last);
    expect((await atlas.packedColumns(view)).rows).toHaveLength(COLUMNS * 300);
  });

  it("is asked for another device once, and goes on", async () => {
    let opened = 0;
    const openGraphics = async () => stoppingAfter(opened++ === 0 ? 5 : COLUMNS);
    const { by, without, picture } = await drawn(
      new AtlasDrawing(atlas, FOUND, { openGraphics, losses: new Losses() }),
    );
    expect({ by, without, opened }).toEqual({ by: FOUND.name, without: undefined, opened: 2 });
    expect(picture.every((square) => square === 1)).toBe(true);
  });

  it("is left alone for the visit after two losses within a minute: the processor's picture", async () => {
    const expected = (await drawn(new AtlasDrawing(atlas, undefined))).picture;
    let opened = 0;
    const openGraphics = async () => {
      opened++;
      return stoppingAfter(5);
    };
    const losses = new Losses();
    for (let time = 0; time < 2; time++) {
      const { by, without, picture } = await drawn(new AtlasDrawing(atlas, FOUND, { openGraphics, losses }));
      expect({ by, without, opened }).toEqual({ by: undefined, without: "lost", opened: 2 });
      expect(picture).toEqual(expected);
    }
  });

  it("is not asked for what is too large for it, which is no loss", async () => {
    const openGraphics = () => Promise.reject(new StrutError({ code: "bad-input", message: "Too large.", hint: "" }));
    const losses = new Losses();
    for (let time = 0; time < 3; time++)
      expect(await drawn(new AtlasDrawing(atlas, FOUND, { openGraphics, losses }))).toMatchObject({
        without: "refused",
      });
    expect(losses.isGivenUp).toBe(false);
  });

  it("is asked again where the losses are far apart", () => {
    let now = 0;
    const losses = new Losses(() => now);
    losses.add();
    now = 61_000;
    losses.add();
    expect(losses.isGivenUp).toBe(false);
    now = 120_000;
    losses.add();
    expect(losses.isGivenUp).toBe(true);
  });
});
