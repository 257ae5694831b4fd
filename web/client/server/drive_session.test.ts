import { expect, test } from "vitest";
import { DEFAULT_OPTIONS, type Styled } from "../../engine/types";
import { POSE_FLOATS } from "../../humanoid";
import { STILL } from "../drive/protocol";
import type { StyleWeights, StylizeOptions } from "../protocol";
import { DriveSession, type NeutralDriver } from "./drive_session";
import type { OnlineStylizer } from "./session";

const RATE_HZ = 60;

/** A fake engine that refuses options when it is told to. */
class FakeStylizer {
  readonly classes = [{ action: "walk", style: "neutral", frames: 100 }];
  weights = new Float32Array(2);
  refuses = false;
  configure(): void {
    if (this.refuses) throw new Error("refused");
  }
  setWeights(weights: Float32Array): void {
    this.weights = weights.slice();
  }
  setPartWeights(): void {}
  setStyleShare(): void {}
  reset(): void {}
  weightsOf({ neutral = 0, old = 0 }: StyleWeights): Float32Array {
    return new Float32Array([neutral, old]);
  }
  push(poses: Float32Array): Styled {
    const frames = poses.length / POSE_FLOATS;
    return {
      poses: poses.slice(),
      durations: new Float32Array(frames).fill(1 / RATE_HZ),
      planted: new Uint8Array(2 * frames),
      classWeights: new Float32Array([1]),
    };
  }
}

/** A driver that stands. */
const driver = {
  clips: ["walk"],
  progress: 0,
  path: new Float32Array(),
  reset() {},
  next: () => ({
    pose: new Float32Array(POSE_FLOATS),
    planted: new Float32Array(POSE_FLOATS),
    root: new Float32Array(3),
    asked: new Float32Array(),
    ahead: new Float32Array(),
    styleShare: 1,
    switched: false,
    speed: 0,
    clip: 0,
    row: 0,
    move: undefined,
  }),
} as unknown as NeutralDriver;

const old = (weight: number): StylizeOptions => ({ ...DEFAULT_OPTIONS, styles: { old: weight } });

test("refused options change neither the settings nor the styles of a driven character", () => {
  const stylizer = new FakeStylizer();
  const online = stylizer as OnlineStylizer & FakeStylizer;
  const session = new DriveSession(online, driver, ["neutral", "old"], RATE_HZ, "", old(0), (a) => a, [0, 0, 0]);
  stylizer.refuses = true;
  expect(() => session.configure(old(1))).toThrow("refused");
  for (let frame = 0; frame < 50; frame++) session.drive(1 / RATE_HZ, STILL);
  expect(stylizer.weights[1]).toBe(0);
  stylizer.refuses = false;
  session.configure(old(1));
  for (let frame = 0; frame < 50; frame++) session.drive(1 / RATE_HZ, STILL);
  expect(stylizer.weights[1]).toBeGreaterThan(0.9);
});
