/** Values of a curve in the examples from which a clip was predicted, and their band. Pure functions. */
import type { Examples } from "../../../../client/protocol";
import { type Measure, measuredAt } from "./curves";

/** The examples of every frame, in the unit of the curve. */
export interface ExampleCurves {
  /** Index of the first example of each frame, and the end after the last frame. */
  starts: Uint32Array;
  values: Float32Array;
  /** Weight of each example, 0–1. */
  weights: Float32Array;
  /** Weighted mean of each frame's examples, minus and plus their weighted standard deviation: the confidence band. */
  low: Float32Array;
  high: Float32Array;
}

/** The examples of a clip for its curve. Angles are unwrapped to the value nearest to the curve's. */
export function exampleCurves(examples: Examples, measure: Measure, curve: Float32Array): ExampleCurves {
  const { counts, weights } = examples;
  const size = measure.kind === "height" ? 1 : 4;
  const frames = Math.min(counts.length, curve.length);
  const starts = new Uint32Array(frames + 1);
  const values = new Float32Array(weights.length);
  const [low, high] = [new Float32Array(frames), new Float32Array(frames)];
  for (let frame = 0; frame < frames; frame++) {
    const from = starts[frame]!;
    const to = from + counts[frame]!;
    starts[frame + 1] = to;
    const own = curve[frame]!;
    let [total, sum, squares] = [0, 0, 0];
    for (let i = from; i < to; i++) {
      const apart = measuredAt(examples.values, size * i, measure) - own;
      const near = measure.kind === "height" ? apart : apart - 360 * Math.round(apart / 360);
      values[i] = own + near;
      total += weights[i]!;
      sum += weights[i]! * near;
      squares += weights[i]! * near * near;
    }
    const mean = total > 0 ? sum / total : 0;
    const deviation = total > 0 ? Math.sqrt(Math.max(0, squares / total - mean * mean)) : 0;
    low[frame] = own + mean - deviation;
    high[frame] = own + mean + deviation;
  }
  return { starts, values, weights, low, high };
}
