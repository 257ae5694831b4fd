/** Converts the styling part of a link to the engine's options. */
import type { StylizeOptions } from "../client/protocol";
import { engineWeights, type Selection } from "../ui/polygon/selection";
import type { PlayState } from "./play";

/** The engine's options for a state. */
export function engineOptions(state: PlayState, neutral: string): StylizeOptions {
  const { k, lambda, rho, kappa, delta, tempo, coherence, timing, footplant, method } = state;
  const { action, inputStyle, intensity } = state;
  const weights = (styles: Selection) => engineWeights(styles, intensity, neutral);
  const parts = Object.entries(state.parts).map(([part, styles]) => [part, weights(styles)]);
  return {
    styles: weights(state.styles),
    parts: Object.fromEntries(parts),
    track: state.track.map(({ frame, styles }) => ({ frame, styles: weights(styles) })),
    k,
    lambda,
    rho,
    kappa,
    delta,
    tempo,
    coherence,
    timing,
    footplant,
    method,
    action,
    inputStyle,
  };
}
