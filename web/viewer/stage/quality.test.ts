import { describe, expect, it } from "vitest";
import { pixelRatio, QUALITY_LEVELS, QualityGovernor } from "./quality";

/** Draws for `seconds` at `fps`; returns how often the level changed. */
function draw(governor: QualityGovernor, seconds: number, fps: number): number {
  let changes = 0;
  for (let i = 0; i < seconds * fps; i++) if (governor.frame(1 / fps)) changes++;
  return changes;
}

describe("pixel ratio", () => {
  const cheap = { ...QUALITY_LEVELS[0]!, pixels: 400_000 };

  it("keeps a small picture sharp and spares a large one", () => {
    expect(pixelRatio(cheap, 390 * 256, 3, false)).toBe(2);
    expect(pixelRatio(cheap, 1_600_000, 1, false)).toBeCloseTo(0.5, 5);
  });

  it("never exceeds the screen's own, of which a still picture has twice", () => {
    expect(pixelRatio(QUALITY_LEVELS[0]!, 1e6, 1, false)).toBe(1);
    expect(pixelRatio(QUALITY_LEVELS[0]!, 1e6, 1, true)).toBe(2);
    expect(pixelRatio(QUALITY_LEVELS[0]!, 1e6, 0.5, true)).toBe(1);
    expect(pixelRatio(QUALITY_LEVELS[0]!, 1e6, 3, true)).toBe(2);
  });
});

describe("quality governor", () => {
  it("keeps the best level while frames come in time", () => {
    const governor = new QualityGovernor();
    expect(draw(governor, 20, 60)).toBe(0);
    expect(governor.level).toBe(0);
  });

  it("lowers the level only after a while of slow frames, and not below the last", () => {
    const governor = new QualityGovernor();
    expect(draw(governor, 1, 20)).toBe(0);
    expect(draw(governor, 1, 60)).toBe(0);
    expect(draw(governor, 2, 20)).toBe(1);
    draw(governor, 60, 5);
    expect(governor.level).toBe(QUALITY_LEVELS.length - 1);
  });

  it("decides nothing in the first seconds of a page that is loading", () => {
    const governor = new QualityGovernor(0, { isLoading: true });
    expect(draw(governor, 3, 10)).toBe(0);
    expect(draw(governor, 2, 10)).toBe(1);
  });

  it("asks less of the levels that slow machines end up with", () => {
    const governor = new QualityGovernor(2);
    draw(governor, 20, 30);
    expect(governor.level).toBe(2);
  });

  it("tries a better level again, less and less often, and never more than the first", () => {
    const governor = new QualityGovernor(1);
    draw(governor, 2, 20);
    expect(governor.level).toBe(2);
    expect(draw(governor, 6, 60)).toBe(1);
    expect(governor.level).toBe(1);
    draw(governor, 2, 20);
    expect(draw(governor, 15, 60)).toBe(0);
    expect(draw(governor, 60, 60)).toBe(1);
    expect(governor.level).toBe(1);
  });

  it("does not take a hidden tab for a slow one", () => {
    const governor = new QualityGovernor();
    for (let i = 0; i < 20; i++) governor.frame(1);
    expect(governor.level).toBe(0);
  });

  it("reports the rate", () => {
    const governor = new QualityGovernor();
    const rates: number[] = [];
    governor.onFps = (fps) => rates.push(Math.round(fps));
    draw(governor, 1.1, 50);
    expect(rates).toEqual([50, 50]);
  });
});
