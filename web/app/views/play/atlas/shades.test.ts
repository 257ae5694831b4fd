import { describe, expect, it } from "vitest";
import { bandsOf, NEAREST, ramp, SHADES, Shades, shadeOf, shifted, zoomed } from "./shades";

describe("shades", () => {
  it("go from the least distance to 3.2 times it", () => {
    expect(shadeOf(0.1, 0.1)).toBe(SHADES - 1);
    expect(shadeOf(0.32, 0.1)).toBe(0);
    expect(shadeOf(0.21, 0.1)).toBe(128);
    expect(shadeOf(9, 0.1)).toBe(0);
    expect(shadeOf(Number.POSITIVE_INFINITY, 0.1)).toBe(0);
  });

  it("of an input that is in the database begin where one take of a walk is apart, by the part that is compared", () => {
    const levels = (nearest: number, distances: number[]) => {
      const shades = new Shades(1, distances.length, nearest);
      shades.take(
        0,
        1,
        Float32Array.from(distances, (distance) => distance * distance),
        true,
      );
      return [...shades.levels];
    };
    expect(levels(NEAREST.whole, [0, 0.04, 0.13])).toEqual([255, 255, 0]);
    expect(levels(NEAREST.legs, [0, 0.024, 0.08])).toEqual([255, 255, 0]);
    // If all windows are within the threshold of the head, not all are bright.
    expect(levels(NEAREST.head, [0, 0.02, 0.04])).toEqual([255, 0, 0]);
  });

  it("of a column stand for those after it until they come", () => {
    const shades = new Shades(5, 2, NEAREST.whole);
    shades.take(0, 4, Float32Array.of(0.01, 0.04), true);
    expect([...shades.levels]).toEqual([255, 255, 255, 255, 0, 139, 139, 139, 139, 0]);
    shades.take(2, 2, Float32Array.of(0.04, 0.01), true);
    expect([...shades.levels]).toEqual([255, 255, 139, 139, 0, 139, 139, 255, 255, 0]);
    shades.take(4, 4, Float32Array.of(0.01, 0.01), true);
    expect(shades.levels).toHaveLength(10);
    expect([shades.brightest(0), shades.brightest(2)]).toEqual([0, 1]);
  });

  it("keep the least distances of the whole while a part is shown", () => {
    const whole = new Shades(1, 1, NEAREST.whole);
    whole.take(0, 1, Float32Array.of(0.01), true);
    const part = new Shades(1, 1, NEAREST.whole, whole.least);
    part.take(0, 1, Float32Array.of(0.04), false);
    expect(part.levels[0]).toBe(139);
    expect(whole.least[0]).toBeCloseTo(0.1, 6);
  });

  it("have the colours between their stops", () => {
    const colours = ramp([
      [0, 0, 0],
      [100, 50, 0],
      [200, 50, 255],
    ]);
    expect([...colours.slice(0, 3)]).toEqual([0, 0, 0]);
    expect([...colours.slice(-3)]).toEqual([200, 50, 255]);
    expect(colours[3 * 64]).toBe(50);
  });
});

describe("what is shown", () => {
  it("keeps its place under the pointer, and stays within the windows", () => {
    expect(zoomed({ first: 0, last: 1000 }, 0.5, 0.25, 60, 1000)).toEqual({ first: 125, last: 625 });
    expect(zoomed({ first: 125, last: 625 }, 2, 0.25, 60, 1000)).toEqual({ first: 0, last: 1000 });
    expect(zoomed({ first: 0, last: 100 }, 0.01, 1, 60, 1000)).toEqual({ first: 40, last: 100 });
    expect(zoomed({ first: 900, last: 1000 }, 2, 0, 60, 1000)).toEqual({ first: 800, last: 1000 });
    expect(zoomed({ first: 0, last: 20 }, 0.5, 0.5, 60, 20)).toEqual({ first: 0, last: 20 });
    expect(shifted({ first: 10, last: 20 }, -50, 100)).toEqual({ first: 0, last: 10 });
    expect(shifted({ first: 10, last: 20 }, 500, 100)).toEqual({ first: 90, last: 100 });
  });

  it("is labelled by styles where there is room, else by actions", () => {
    const classes = [
      { action: "run", style: "neutral" },
      { action: "run", style: "proud" },
      { action: "walk", style: "neutral" },
    ];
    const firsts = [0, 100, 110, 200];
    expect(bandsOf(classes, firsts, { first: 0, last: 200 }, 60)).toEqual([
      { label: "run", first: 0, last: 110 },
      { label: "walk neutral", first: 110, last: 200 },
    ]);
    expect(bandsOf(classes, firsts, { first: 50, last: 110 }, 5)).toEqual([
      { label: "run neutral", first: 50, last: 100 },
      { label: "proud", first: 100, last: 110 },
    ]);
  });
});
