/** Styles over time: the weights between the keys of a style track. Pure. */

/** The weights of every style that a track has reached at an input frame. */
export interface WeightKey {
  frame: number;
  weights: Float32Array;
}

/**
 * Weights at a fractional input frame: those of the first key before it, of the last key after it, and between two
 * keys their linear mixture, so that a transition takes as long as its keys are apart.
 * @param keys at least one, in the order of frames
 * @param out receives the weights
 */
export function weightsAt(keys: readonly WeightKey[], frame: number, out: Float32Array): void {
  const after = keys.findIndex((key) => key.frame > frame);
  const b = keys[after < 0 ? keys.length - 1 : after]!;
  const a = after > 0 ? keys[after - 1]! : b;
  const share = b.frame > a.frame ? (frame - a.frame) / (b.frame - a.frame) : 0;
  for (let i = 0; i < out.length; i++) out[i] = a.weights[i]! + (b.weights[i]! - a.weights[i]!) * share;
}
