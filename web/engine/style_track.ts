/** Styles over time: interpolates the weights between the keys of a style track. Pure functions. */

/** The weights of all styles that a track reaches at an input frame. */
export interface WeightKey {
  frame: number;
  weights: Float32Array;
}

/**
 * Weights at a fractional input frame: those of the first key before it, of the last key after it, and a linear mixture
 * between two keys. A transition lasts as long as the distance between its keys.
 * @param keys at least one, ordered by frame
 * @param out receives the weights
 */
export function weightsAt(keys: readonly WeightKey[], frame: number, out: Float32Array): void {
  const after = keys.findIndex((key) => key.frame > frame);
  const b = keys[after < 0 ? keys.length - 1 : after]!;
  const a = after > 0 ? keys[after - 1]! : b;
  const share = b.frame > a.frame ? (frame - a.frame) / (b.frame - a.frame) : 0;
  for (let i = 0; i < out.length; i++) out[i] = a.weights[i]! + (b.weights[i]! - a.weights[i]!) * share;
}
