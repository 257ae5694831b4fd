import { describe, expect, it } from "vitest";
import { FADE_STEPS, FootprintTrail, MAX_PRINTS, type Sole } from "./footprint_trail";

const sole = (z: number, tilt = 0): Sole => ({ x: 0, z, heading: 0, tilt });

/** Adds `steps` alternating steps, half a metre each. */
function walk(trail: FootprintTrail, steps: number): void {
  for (let step = 0; step < steps; step++) {
    const left = step % 2 === 0;
    trail.update([left, !left], [sole(step / 2), sole(step / 2)]);
  }
}

describe("footprint trail", () => {
  it("makes one print a step, the newest planted", () => {
    const trail = new FootprintTrail();
    walk(trail, 3);
    expect(trail.prints.map(({ side, planted, age }) => [side, planted, age])).toEqual([
      [0, false, 2],
      [1, false, 1],
      [0, true, 0],
    ]);
  });

  it("puts the print where the sole was flattest", () => {
    const trail = new FootprintTrail();
    trail.update([true, false], [sole(0, 0.4), sole(0)]);
    trail.update([true, false], [sole(0.05, 0.02), sole(0)]);
    trail.update([true, false], [sole(0.2, 0.6), sole(0)]);
    expect(trail.prints).toHaveLength(1);
    expect(trail.prints[0]!.z).toBe(0.05);
  });

  it("forgets prints after a few steps and never grows", () => {
    const trail = new FootprintTrail();
    walk(trail, 100);
    expect(trail.prints.length).toBeLessThanOrEqual(MAX_PRINTS);
    expect(Math.max(...trail.prints.map(({ age }) => age))).toBe(FADE_STEPS);
    expect(trail.prints.filter(({ planted }) => planted)).toHaveLength(1);
  });

  it("begins anew after a jump", () => {
    const trail = new FootprintTrail();
    walk(trail, 3);
    trail.clear();
    expect(trail.prints).toHaveLength(0);
    trail.update([true, true], [sole(9), sole(9)]);
    expect(trail.prints.map(({ planted }) => planted)).toEqual([true, true]);
  });
});
