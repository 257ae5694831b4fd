import { describe, expect, it } from "vitest";
import { QUALITY_LEVELS, QualityGovernor } from "./quality";

/** Draws for `seconds` at `fps`; returns how often the level changed. */
function draw(governor: QualityGovernor, seconds: number, fps: number): number {
  let changes = 0;
  for (let i = 0; i < seconds * fps; i++) if (governor.frame(1 / fps)) changes++;
  return changes;
}

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
    draw(governor, 60, 20);
    expect(governor.level).toBe(QUALITY_LEVELS.length - 1);
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
