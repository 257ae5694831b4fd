/**
 * Plane geometry of the style polygon: positions of vertices, and conversion between points and weights. No DOM, no
 * styles.
 *
 * Screen convention: x right, y down, the centre of the polygon at the origin. A point and the weights of its corners
 * are equivalent: the point is Σ wᵢ·cornerᵢ ({@link pointOf}) and {@link weightsAt} is the inverse.
 */

/** A point of the plane. */
export interface Point {
  x: number;
  y: number;
}

/** Below this distance (in the polygon's own units, pixels) two points are equal. */
const EPSILON = 1e-6;

const subtract = (a: Point, b: Point): Point => ({ x: a.x - b.x, y: a.y - b.y });
const dot = (a: Point, b: Point): number => a.x * b.x + a.y * b.y;
const cross = (a: Point, b: Point): number => a.x * b.y - a.y * b.x;
const lerp = (a: Point, b: Point, t: number): Point => ({ x: a.x + (b.x - a.x) * t, y: a.y + (b.y - a.y) * t });
const clamp01 = (t: number): number => Math.min(1, Math.max(0, t));

/** Distance of two points. */
export function distance(a: Point, b: Point): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

/** The unit vector from the centre to a point; the centre itself has none. */
export function direction(p: Point): Point {
  const length = Math.hypot(p.x, p.y) || 1;
  return { x: p.x / length, y: p.y / length };
}

/** `count` vertices of a regular polygon, clockwise from the top. */
export function circleVertices(count: number, radius: number): Point[] {
  return Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * i) / count;
    return { x: radius * Math.sin(angle), y: -radius * Math.cos(angle) };
  });
}

/** The point of `weights` over `corners`: Σ wᵢ·cornerᵢ. */
export function pointOf(weights: readonly number[], corners: readonly Point[]): Point {
  return corners.reduce<Point>(
    (sum, corner, i) => ({ x: sum.x + (weights[i] ?? 0) * corner.x, y: sum.y + (weights[i] ?? 0) * corner.y }),
    { x: 0, y: 0 },
  );
}

/** Barycentric coordinates in the triangle a b c; they sum to 1 and leave 0–1 outside it. */
export function barycentric(p: Point, a: Point, b: Point, c: Point): [number, number, number] {
  const area = cross(subtract(b, a), subtract(c, a));
  const wb = cross(subtract(p, a), subtract(c, a)) / area;
  const wc = cross(subtract(b, a), subtract(p, a)) / area;
  return [1 - wb - wc, wb, wc];
}

/** Parameter of the projection of `p` onto the line a → b: 0 at a, 1 at b. */
function alongSegment(p: Point, a: Point, b: Point): number {
  const edge = subtract(b, a);
  const length2 = dot(edge, edge);
  return length2 < EPSILON * EPSILON ? 0 : dot(subtract(p, a), edge) / length2;
}

/** The point of the segment a–b that is nearest to `p`. */
function nearestOnSegment(p: Point, a: Point, b: Point): Point {
  return lerp(a, b, clamp01(alongSegment(p, a, b)));
}

/** Whether `p` lies in the convex polygon `corners` or on its border; either orientation. */
export function isInside(p: Point, corners: readonly Point[]): boolean {
  let sign = 0;
  for (const [i, corner] of corners.entries()) {
    const next = corners[(i + 1) % corners.length]!;
    const side = cross(subtract(next, corner), subtract(p, corner));
    if (Math.abs(side) < EPSILON) continue;
    if (sign !== 0 && Math.sign(side) !== sign) return false;
    sign = Math.sign(side);
  }
  return true;
}

/** The point of the corner, segment or convex polygon nearest to `p`: `p` itself if it is inside. */
export function nearestInside(p: Point, corners: readonly Point[]): Point {
  if (corners.length === 0) return { x: 0, y: 0 };
  if (corners.length > 2 && isInside(p, corners)) return p;
  let best = corners[0]!;
  for (const [i, corner] of corners.entries()) {
    const candidate = nearestOnSegment(p, corner, corners[(i + 1) % corners.length]!);
    if (distance(candidate, p) < distance(best, p)) best = candidate;
  }
  return best;
}

/**
 * Mean value coordinates (Floater 2003) of a point inside a convex polygon: smooth, positive, exact at corners and
 * along edges, and Σ wᵢ·cornerᵢ = p. With wᵢ = (tan(αᵢ₋₁/2) + tan(αᵢ/2)) / |cornerᵢ − p|, αᵢ the angle at p between
 * corners i and i+1.
 */
export function meanValue(p: Point, corners: readonly Point[]): number[] {
  const n = corners.length;
  const towards = corners.map((corner) => subtract(corner, p));
  const lengths = towards.map((v) => Math.hypot(v.x, v.y));
  const at = lengths.findIndex((length) => length < EPSILON);
  if (at >= 0) return corners.map((_, i) => (i === at ? 1 : 0));
  const halfTangents: number[] = [];
  for (let i = 0; i < n; i++) {
    const j = (i + 1) % n;
    const area = Math.abs(cross(towards[i]!, towards[j]!));
    const inner = dot(towards[i]!, towards[j]!);
    if (area < EPSILON && inner < 0) {
      const t = alongSegment(p, corners[i]!, corners[j]!);
      return corners.map((_, k) => (k === i ? 1 - t : k === j ? t : 0));
    }
    halfTangents.push((lengths[i]! * lengths[j]! - inner) / Math.max(area, EPSILON));
  }
  const raw = lengths.map((length, i) => (halfTangents[(i + n - 1) % n]! + halfTangents[i]!) / length);
  const sum = raw.reduce((a, b) => a + b, 0);
  return raw.map((w) => w / sum);
}

/**
 * Weights of `corners` at `p`, summing to 1. A single corner has weight 1, two share a segment, three are barycentric
 * (also outside), more are mean value coordinates (`p` must be inside).
 */
export function weightsAt(p: Point, corners: readonly Point[]): number[] {
  const [a, b, c] = corners;
  if (!a) return [];
  if (!b) return [1];
  if (!c) {
    const t = alongSegment(p, a, b);
    return [1 - t, t];
  }
  return corners.length === 3 ? barycentric(p, a, b, c) : meanValue(p, corners);
}

/** Lines of equal weight of a triangle at a quarter, a half and three quarters, parallel to each side. */
export function quarterIsolines(a: Point, b: Point, c: Point): [Point, Point][] {
  return [0.25, 0.5, 0.75].flatMap((t) =>
    (
      [
        [a, b, c],
        [b, c, a],
        [c, a, b],
      ] as const
    ).map(([apex, left, right]): [Point, Point] => [lerp(apex, left, t), lerp(apex, right, t)]),
  );
}
