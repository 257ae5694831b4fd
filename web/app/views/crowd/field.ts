/** The styles of places: pure edits of plain data. */

import { type FieldVertex, MAX_VERTICES } from "../../../client/crowd/limits";
import { rounded } from "../../../ui/controls/range";
import { firstStyles } from "../../../ui/polygon/selection";
import { CROWD_RANGES } from "../../state/crowd";

/** Initial positions of the first three styles, metres, and their reach. */
const FIRST_PLACES = [
  { x: -3.4, z: 3.4, reach: 3.2, intensity: 1 },
  { x: 4, z: 0.8, reach: 3.2, intensity: 1.1 },
  { x: -1.5, z: -5.2, reach: 4, intensity: 1 },
] as const;
/** Initial positions for a smaller crowd, whose ground is smaller. */
const NEW = { reach: 3, intensity: 1 } as const;
/** Minimum distance of a new vertex from the others, metres. */
const ROOM = 3;
/** Angle from one candidate position for a new vertex to the next, radians, and how far the spiral grows per turn, metres. */
const GOLDEN_ANGLE = 2.4;
const CANDIDATES = 60;

/** The field of a first visit: up to three clearly different styles. */
export function firstField(styles: readonly string[], neutral: string): FieldVertex[] {
  return firstStyles(styles, neutral).map((style, i) => ({ style, ...FIRST_PLACES[i]! }));
}

/** The vertices with one of them changed, clamped and rounded as in links. */
export function withVertex(
  field: readonly FieldVertex[],
  index: number,
  patch: Partial<Omit<FieldVertex, "style">>,
): FieldVertex[] {
  return field.map((vertex, i) => (i === index ? roundedVertex({ ...vertex, ...patch }) : vertex));
}

/** The vertices with a new vertex of a style, at a free place within a circle. */
export function withStyle(field: readonly FieldVertex[], style: string, radius: number): FieldVertex[] {
  if (field.length >= MAX_VERTICES) return [...field];
  const far = (x: number, z: number) => Math.min(...field.map((vertex) => Math.hypot(vertex.x - x, vertex.z - z)));
  // From the middle outwards along a spiral, where it is easily seen.
  const places = Array.from({ length: CANDIDATES }, (_, i) => {
    const out = 0.85 * radius * Math.sqrt(i / CANDIDATES);
    return { x: out * Math.sin(i * GOLDEN_ANGLE), z: out * Math.cos(i * GOLDEN_ANGLE) };
  });
  const place = places.find(({ x, z }) => far(x, z) >= ROOM) ?? places[field.length]!;
  return [...field, roundedVertex({ style, ...place, ...NEW })];
}

/** The vertices without one. */
export function withoutVertex(field: readonly FieldVertex[], index: number): FieldVertex[] {
  return field.filter((_, i) => i !== index);
}

/** A style of the field that the model lacks. */
export function unknownStyle(field: readonly FieldVertex[], styles: readonly string[]): string | undefined {
  return field.find(({ style }) => !styles.includes(style))?.style;
}

function roundedVertex({ style, x, z, reach, intensity }: FieldVertex): FieldVertex {
  const { place, reach: reaches, intensity: intensities } = CROWD_RANGES;
  return {
    style,
    x: rounded(x, place),
    z: rounded(z, place),
    reach: rounded(reach, reaches),
    intensity: rounded(intensity, intensities),
  };
}
