/**
 * The selected styles and their weights: pure edits of a {@link Selection}, and the design's order of the vertices. The
 * polygon and the URL both use selections.
 */

/** A style and its weight. Weights of a selection sum to 1; they leave 0–1 only beyond the polygon. */
export interface StyleWeight {
  name: string;
  weight: number;
}
/** The selected styles, in the order of selection; a selected style may have weight 0. */
export type Selection = readonly StyleWeight[];

/** Maximum number of styles of the triangle. */
export const TRIANGLE = 3;
/** Weights below this are dropped when the whole polygon is mixed: they are not visible, and each style costs time. */
const NEGLIGIBLE = 0.005;
/** The order of the paper's eight styles around the polygon, clockwise from the top: opposites face each other. */
const DESIGN_ORDER = ["proud", "strutting", "angry", "childlike", "neutral", "old", "sexy", "depressed"];
/** The styles that are selected initially, if a database has them, and their weights. */
const FIRST_CHOICE = ["proud", "old", "childlike"];
const FIRST_WEIGHTS = [0.62, 0.12, 0.26];

const rank = (order: readonly string[], name: string): number => {
  const i = order.indexOf(name);
  return i < 0 ? order.length : i;
};
const byRank = (order: readonly string[]) => (a: string, b: string) => rank(order, a) - rank(order, b);

/** The default styles: three of the database, the neutral one only if there are too few others. */
export function firstStyles(styles: readonly string[], neutral: string): string[] {
  const ranked = [...styles].filter((s) => s !== neutral).sort(byRank(FIRST_CHOICE));
  return [...ranked, ...styles.filter((s) => s === neutral)].slice(0, TRIANGLE);
}

/** The default selection. */
export function firstSelection(styles: readonly string[], neutral: string): Selection {
  const names = firstStyles(styles, neutral);
  return normalised(names.map((name, i) => ({ name, weight: FIRST_WEIGHTS[i]! })));
}

/**
 * The styles clockwise from the top: the first three spread out so that their triangle is wide, neutral at the bottom,
 * the others between them in the design's order.
 */
export function vertexOrder(styles: readonly string[], neutral: string): string[] {
  const n = styles.length;
  const slots: (string | undefined)[] = new Array(n).fill(undefined);
  const picks = firstStyles(styles, neutral);
  const spread = Math.max(1, Math.floor(((n - 1) * 3) / 7));
  // Clockwise the third style comes before the second: proud at the top, old at the lower left, childlike at the right.
  const places = [0, n - spread, spread];
  picks.forEach((name, i) => {
    slots[places[i]! % n] = name;
  });
  const bottom = Math.round(n / 2);
  if (!picks.includes(neutral) && slots[bottom] === undefined) slots[bottom] = neutral;
  const rest = styles.filter((s) => !slots.includes(s)).sort(byRank(DESIGN_ORDER));
  return slots.map((name) => name ?? rest.shift()!);
}

/** The selection with weights that sum to 1 (equal weights if all are 0). */
export function normalised(selection: Selection): Selection {
  const sum = selection.reduce((total, s) => total + s.weight, 0);
  if (Math.abs(sum) < 1e-6) return selection.map((s) => ({ ...s, weight: 1 / selection.length }));
  return selection.map((s) => ({ ...s, weight: s.weight / sum }));
}

/** Weight of a style, 0 if it is not selected. */
export function weightOf(selection: Selection, name: string): number {
  return selection.find((s) => s.name === name)?.weight ?? 0;
}

/** Selects a style. In a full triangle it replaces the style with the smallest weight, and gets its weight. */
export function select(selection: Selection, name: string): Selection {
  if (selection.some((s) => s.name === name)) return selection;
  if (selection.length < TRIANGLE) return [...selection, { name, weight: 0 }];
  const lightest = selection.reduce((a, b) => (b.weight < a.weight ? b : a));
  return selection.map((s) => (s === lightest ? { name, weight: s.weight } : s));
}

/** Deselects a style; its weight is distributed to the others in proportion. The last one stays. */
export function drop(selection: Selection, name: string): Selection {
  if (selection.length < 2 || !selection.some((s) => s.name === name)) return selection;
  return normalised(selection.filter((s) => s.name !== name));
}

/** The selection with another weight of a style; the others keep their proportions, or share equally if all are 0. */
export function withWeight(selection: Selection, name: string, weight: number): Selection {
  const others = normalised(selection.filter((s) => s.name !== name));
  if (others.length === 0 || others.length === selection.length) return selection;
  return selection.map((s) => ({
    name: s.name,
    weight: s.name === name ? weight : (1 - weight) * weightOf(others, s.name),
  }));
}

/** One style alone, which is selected if it was not. */
export function allOf(selection: Selection, name: string): Selection {
  return select(selection, name).map((s) => ({ name: s.name, weight: s.name === name ? 1 : 0 }));
}

/** The selection of the whole polygon from the weights of its vertices. */
export function fromPolygon(names: readonly string[], weights: readonly number[]): Selection {
  return normalised(
    names.map((name, i) => ({ name, weight: weights[i] ?? 0 })).filter((s) => Math.abs(s.weight) >= NEGLIGIBLE),
  );
}

/**
 * How unevenly corners divide the vertices of a polygon with `count` vertices: the sum of the squares of the parts and,
 * among equals, the difference of those next to the first corner.
 */
function unevenness(corners: readonly number[], count: number): number {
  const places = corners.map((corner) => (corner - corners[0]! + count) % count).sort((a, b) => a - b);
  const parts = places.map((place, i) => (places[i + 1] ?? count) - place);
  const squares = parts.reduce((sum, part) => sum + part * part, 0);
  return squares + Math.abs(parts[0]! - parts.at(-1)!) / (count + 1);
}

/** Vertices that extend `corners` to the widest triangle; fewer if the polygon has no more. */
function widened(corners: readonly number[], count: number): readonly number[] {
  if (corners.length >= Math.min(TRIANGLE, count)) return corners;
  const others = Array.from({ length: count }, (_, i) => i).filter((i) => !corners.includes(i));
  const triangles = others.map((i) => widened([...corners, i], count));
  return triangles.reduce((a, b) => (unevenness(b, count) < unevenness(a, count) ? b : a));
}

/**
 * The triangle nearest to a selection of the whole polygon: its heaviest styles. If there are fewer than three, those
 * of the `vertices`, in their order around the polygon, that make the triangle widest are added.
 */
export function toTriangle(selection: Selection, vertices: readonly string[]): Selection {
  const heaviest = [...selection].sort((a, b) => b.weight - a.weight).slice(0, TRIANGLE);
  const corners = heaviest.map(({ name }) => vertices.indexOf(name));
  const others = widened(corners, vertices.length).slice(heaviest.length);
  return normalised([...heaviest, ...others.map((i) => ({ name: vertices[i]!, weight: 0 }))]);
}

/**
 * The weights for the engine: each style's weight times the intensity. The neutral style is left out, since it has the
 * remainder to 1.
 */
export function engineWeights(selection: Selection, intensity: number, neutral: string): Record<string, number> {
  return Object.fromEntries(
    selection.filter((s) => s.name !== neutral).map((s) => [s.name, Math.round(s.weight * intensity * 1e6) / 1e6]),
  );
}

/** Whether the weights extrapolate beyond the data: one is below 0 or above 1. */
export function isBeyondData(selection: Selection, intensity: number): boolean {
  return selection.some((s) => s.weight * intensity < -1e-3 || s.weight * intensity > 1 + 1e-3);
}
