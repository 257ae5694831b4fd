/**
 * Lofted surfaces: superellipse cross-sections along an axis, closed by elliptical caps.
 *
 * Stations are joined by Hermite splines with Catmull–Rom tangents, so that a limb swells and tapers without a ridge.
 * Every loft is indexed with its seam welded and its caps ending in one pole vertex: a closed surface whose normals are
 * smooth everywhere.
 */

import type { Vec3 } from "./vectors";

/**
 * One cross-section: position along the axis, radii towards +u, −u, +w, −w, and the centre's u and w. Metres. The axes
 * (u, along, w) become x, y, z unless {@link orient} says otherwise.
 */
export type Station = readonly [
  along: number,
  uPlus: number,
  uMinus: number,
  wPlus: number,
  wMinus: number,
  uCentre?: number,
  wCentre?: number,
];

/** Shape and resolution of a loft. */
export interface LoftOptions {
  /** Length of the rounding at the first station, metres; 0 leaves that end open. */
  startCap: number;
  /** Length of the rounding at the last station, metres; 0 leaves that end open. */
  endCap: number;
  /** Superellipse exponent: 2 is an ellipse, larger is boxier. */
  exponent: number;
  /** Rings between the caps; 0 joins them at one ring. */
  rings: number;
  /** Rings in each cap. */
  capRings: number;
  /** Vertices around. */
  segments: number;
  /** Factor on the three counts above. */
  detail: number;
}

/** Resolution and roundness that suit a limb seen from a few metres. */
const LOFT_DEFAULTS: LoftOptions = {
  startCap: 0.02,
  endCap: 0.02,
  exponent: 2.15,
  rings: 14,
  capRings: 5,
  segments: 28,
  detail: 1,
};

/** A count of rings or vertices at a level of detail, at least 2. */
export function atDetail(count: number, detail: number): number {
  return Math.max(2, Math.round(count * detail));
}

/** An indexed triangle mesh in plain arrays. */
export interface Surface {
  /** xyz of every vertex, metres. */
  positions: number[];
  /** Three vertices a triangle, counter-clockwise from outside. */
  indices: number[];
}

/** A station with its centre filled in. */
export type Section = [
  along: number,
  uPlus: number,
  uMinus: number,
  wPlus: number,
  wMinus: number,
  uCentre: number,
  wCentre: number,
];

/** The cross-section at `along`, between stations that are in increasing order. */
export function sectionAt(stations: readonly Station[], along: number): Section {
  const at = (i: number) => stations[Math.min(Math.max(i, 0), stations.length - 1)]!;
  let i = 0;
  while (i < stations.length - 2 && along > at(i + 1)[0]) i++;
  const [k0, k1, k2, k3] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
  const h = k2[0] - k1[0] || 1;
  const t = Math.min(1, Math.max(0, (along - k1[0]) / h));
  const section: Section = [along, 0, 0, 0, 0, 0, 0];
  for (let c = 1; c < 7; c++) {
    const [v0, v1, v2, v3] = [k0[c] ?? 0, k1[c] ?? 0, k2[c] ?? 0, k3[c] ?? 0];
    const m1 = ((v2 - v0) / (k2[0] - k0[0] || 1)) * h;
    const m2 = ((v3 - v1) / (k3[0] - k1[0] || 1)) * h;
    const t2 = t * t;
    const t3 = t2 * t;
    section[c] = (2 * t3 - 3 * t2 + 1) * v1 + (t3 - 2 * t2 + t) * m1 + (3 * t2 - 2 * t3) * v2 + (t3 - t2) * m2;
  }
  return section;
}

/** Factor on the radii from the caps at `along`: an ellipse's quarter at either end, 1 between. */
export function capFactor(along: number, start: number, end: number, startCap: number, endCap: number): number {
  const quarter = (inside: number, cap: number) =>
    cap > 0 && inside < cap ? Math.sqrt(Math.max(0, 1 - ((cap - inside) / cap) ** 2)) : 1;
  return Math.min(quarter(along - start, startCap), quarter(end - along, endCap));
}

/** Point of a superellipse with an exponent at an angle: (u, w) with unit radii. */
export function superellipse(angle: number, exponent: number): [u: number, w: number] {
  const power = 2 / exponent;
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return [Math.sign(c) * Math.abs(c) ** power, Math.sign(s) * Math.abs(s) ** power];
}

/** Lofts the stations, which must be in increasing order along the axis. */
export function loft(stations: readonly Station[], options: Partial<LoftOptions> = {}): Surface {
  const o = { ...LOFT_DEFAULTS, ...options };
  const rings = o.rings && atDetail(o.rings, o.detail);
  const capRings = atDetail(o.capRings, o.detail);
  const n = Math.max(6, atDetail(o.segments, o.detail));
  const start = stations[0]![0];
  const end = stations[stations.length - 1]![0];
  const alongs: number[] = [];
  if (o.startCap > 0)
    for (let i = 1; i < capRings; i++) alongs.push(start + o.startCap * (1 - Math.cos(((i / capRings) * Math.PI) / 2)));
  for (let i = 0; i <= rings; i++)
    alongs.push(start + o.startCap + ((end - o.endCap - start - o.startCap) * i) / Math.max(1, rings));
  if (o.endCap > 0)
    for (let i = 1; i < capRings; i++)
      alongs.push(end - o.endCap + o.endCap * Math.sin(((i / capRings) * Math.PI) / 2));

  const surface: Surface = { positions: [], indices: [] };
  const { positions, indices } = surface;
  for (const along of alongs) {
    const [, uPlus, uMinus, wPlus, wMinus, u0, w0] = sectionAt(stations, along);
    const k = capFactor(along, start, end, o.startCap, o.endCap);
    for (let j = 0; j < n; j++) {
      const [u, w] = superellipse((j / n) * 2 * Math.PI, o.exponent);
      positions.push(u0 + u * (u > 0 ? uPlus : uMinus) * k, along, w0 + w * (w > 0 ? wPlus : wMinus) * k);
    }
  }
  const ring = (i: number, j: number) => i * n + (j % n);
  for (let i = 0; i + 1 < alongs.length; i++)
    for (let j = 0; j < n; j++)
      indices.push(ring(i, j), ring(i + 1, j), ring(i, j + 1), ring(i, j + 1), ring(i + 1, j), ring(i + 1, j + 1));
  const pole = (along: number) => {
    const [, , , , , u0, w0] = sectionAt(stations, along);
    return positions.push(u0, along, w0) / 3 - 1;
  };
  if (o.startCap > 0) {
    const p = pole(start);
    for (let j = 0; j < n; j++) indices.push(p, ring(0, j), ring(0, j + 1));
  }
  if (o.endCap > 0) {
    const p = pole(end);
    const last = alongs.length - 1;
    for (let j = 0; j < n; j++) indices.push(p, ring(last, j + 1), ring(last, j));
  }
  return surface;
}

/** A sphere about the origin, as a loft, so that it has the same topology. */
export function ball(radius: number, detail = 1): Surface {
  const r = radius;
  const station = (along: number): Station => [along, r, r, r, r];
  return loft([station(-r), station(r)], {
    startCap: r,
    endCap: r,
    exponent: 2,
    rings: 0,
    capRings: 5,
    segments: 20,
    detail,
  });
}

/**
 * Maps every vertex (u, along, w) to `u·U + along·V + w·W + origin`. A mirroring basis reverses the triangles, so that
 * they still face outwards.
 */
export function orient(surface: Surface, [u, v, w]: readonly [Vec3, Vec3, Vec3], origin: Vec3 = [0, 0, 0]): Surface {
  const positions: number[] = [];
  for (let i = 0; i < surface.positions.length; i += 3) {
    const [a, b, c] = [surface.positions[i]!, surface.positions[i + 1]!, surface.positions[i + 2]!];
    for (const k of [0, 1, 2] as const) positions.push(a * u[k] + b * v[k] + c * w[k] + origin[k]);
  }
  const determinant =
    u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
  return { positions, indices: determinant < 0 ? surface.indices.toReversed() : surface.indices };
}

/** The surface mirrored to the other side of the body. */
export function mirror(surface: Surface): Surface {
  return orient(surface, [
    [-1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ]);
}

/** Area-weighted vertex normals, unit length. */
export function vertexNormals({ positions, indices }: Surface): Float32Array {
  const normals = new Float32Array(positions.length);
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [3 * indices[t]!, 3 * indices[t + 1]!, 3 * indices[t + 2]!];
    const e = (v: number, axis: number) => positions[v + axis]! - positions[a + axis]!;
    const nx = e(b, 1) * e(c, 2) - e(b, 2) * e(c, 1);
    const ny = e(b, 2) * e(c, 0) - e(b, 0) * e(c, 2);
    const nz = e(b, 0) * e(c, 1) - e(b, 1) * e(c, 0);
    for (const v of [a, b, c]) {
      normals[v]! += nx;
      normals[v + 1]! += ny;
      normals[v + 2]! += nz;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i]!, normals[i + 1]!, normals[i + 2]!) || 1;
    for (let k = i; k < i + 3; k++) normals[k]! /= length;
  }
  return normals;
}
