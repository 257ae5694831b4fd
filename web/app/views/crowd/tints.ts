/** Colours of agents by their styles. */

/** Share of a style's colour on an agent with full weight. */
const TINT = 0.35;

/** Mixes each agent's colour by weights: red, green, blue and its share, one byte each. */
export function tintsOf(weights: Uint8Array, colours: readonly (readonly number[])[], into: Uint8Array): void {
  const styles = colours.length;
  for (let walker = 0; 4 * walker < into.length; walker++) {
    let [red, green, blue, sum] = [0, 0, 0, 0];
    for (let i = 0; i < styles; i++) {
      const weight = weights[walker * styles + i]!;
      const [r, g, b] = colours[i]!;
      red += weight * r!;
      green += weight * g!;
      blue += weight * b!;
      sum += weight;
    }
    const share = sum > 0 ? 1 / sum : 0;
    into[4 * walker] = red * share;
    into[4 * walker + 1] = green * share;
    into[4 * walker + 2] = blue * share;
    into[4 * walker + 3] = Math.min(255, sum) * TINT;
  }
}
