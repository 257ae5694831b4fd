import { expect, test } from "vitest";
import { DEFAULT_OPTIONS, type Styled } from "../../engine/types";
import { POSE_FLOATS } from "../../humanoid";
import type { StyleWeights } from "../protocol";
import { LiveStylizer } from "./live_stylizer";
import type { OnlineStylizer } from "./session";

/** A fake engine with two styles that records its weights. */
class FakeStylizer implements OnlineStylizer {
  classes = [];
  weights: number[] = [];
  refuses = false;

  configure() {
    if (this.refuses) throw new Error("refused");
  }
  setWeights(weights: Float32Array) {
    this.weights = [...weights];
  }
  setPartWeights() {}
  weightsOf(styles: StyleWeights) {
    return new Float32Array([styles.neutral ?? 0, styles.old ?? 0]);
  }
  reset() {}
  push(poses: Float32Array): Styled {
    const count = poses.length / POSE_FLOATS;
    return {
      poses,
      durations: new Float32Array(count).fill(1 / 60),
      planted: new Uint8Array(2 * count),
      classWeights: new Float32Array(0),
    };
  }
}

const styled = (styles: StyleWeights) => ({ ...DEFAULT_OPTIONS, styles });
const frame = new Float32Array(POSE_FLOATS);

test("accepted options change the styles of the next frame", () => {
  const engine = new FakeStylizer();
  const live = new LiveStylizer(engine, styled({ neutral: 1 }), 60, 0);
  live.configure(styled({ old: 1 }), 0);
  live.push(frame);
  expect(engine.weights).toEqual([0, 1]);
});

test("refused options change neither the settings nor the styles", () => {
  const engine = new FakeStylizer();
  const live = new LiveStylizer(engine, styled({ neutral: 1 }), 60, 0);
  engine.refuses = true;
  expect(() => live.configure(styled({ old: 1 }), 0)).toThrow("refused");
  live.push(frame);
  expect(engine.weights).toEqual([1, 0]);
});
