/**
 * A body of prisms for distant agents: one for each large part of the mannequin, with the length and width of the mesh
 * there, so that the change between the two is invisible.
 */

import { JOINT, type Role } from "../humanoid";
import type { Fit } from "./fit";
import { type SkinnedBody, skinnedBody } from "./skinned_body";

/** Number of sides of a prism: of the visible body, and of the body that only casts an outline. */
const SIDES = { seen: 6, outline: 4 };
/** Detail of the mesh that is measured. */
const DETAIL = 0.25;

/** One prism. */
interface Prism {
  /** The joint whose vertices it replaces. */
  joint: Role;
  /** Direction of its axis in the T-pose: left, up or forward. */
  axis: 0 | 1 | 2;
  /** Number of its cross-sections. */
  sections: number;
  tone: number;
  /** The joint that its upper or front end follows, if it differs. */
  to?: Role;
  /** Whether it also replaces the vertices of `to`. */
  both?: true;
  /** Whether its ends are inside other prisms. */
  open?: true;
  /** Index of the only tone whose vertices are used. */
  only?: number;
}

const SHELL = 0;
const DARK = 1;
const X = 0;
const Y = 1;
const Z = 2;

const LIMBS = ["left", "right"] as const;

const PRISMS: readonly Prism[] = [
  { joint: "head", axis: Y, sections: 3, tone: SHELL, only: SHELL },
  { joint: "neck", axis: Y, sections: 2, tone: DARK, open: true },
  { joint: "chest", axis: Y, sections: 3, tone: SHELL, only: SHELL },
  { joint: "hips", to: "chest", axis: Y, sections: 3, tone: DARK },
  ...LIMBS.flatMap((side): Prism[] => [
    { joint: `${side}_upper_arm`, axis: X, sections: 2, tone: SHELL },
    { joint: `${side}_lower_arm`, axis: X, sections: 2, tone: SHELL },
    { joint: `${side}_hand`, axis: X, sections: 2, tone: SHELL },
    { joint: `${side}_upper_leg`, axis: Y, sections: 3, tone: SHELL },
    { joint: `${side}_lower_leg`, axis: Y, sections: 3, tone: SHELL },
    { joint: `${side}_foot`, to: `${side}_toes`, both: true, axis: Z, sections: 2, tone: SHELL },
  ]),
];

/** Builds the bodies for a fit: the visible one, and the one for the outline of a shadow. */
export function prismBodies(fit: Fit): Record<keyof typeof SIDES, SkinnedBody> {
  const mesh = skinnedBody(fit, DETAIL);
  return { seen: prismBody(mesh, SIDES.seen), outline: prismBody(mesh, SIDES.outline) };
}

function prismBody(mesh: SkinnedBody, sides: number): SkinnedBody {
  // A polygon with this circumradius has the area of a circle of radius 1.
  const circumradius = Math.sqrt((2 * Math.PI) / sides / Math.sin((2 * Math.PI) / sides));
  const positions: number[] = [];
  const normals: number[] = [];
  const joints: number[] = [];
  const blends: number[] = [];
  const tones: number[] = [];
  const indices: number[] = [];
  for (const prism of PRISMS) {
    const points = verticesOf(mesh, prism);
    const { axis, sections, tone } = prism;
    const [u, v] = [(axis + 1) % 3, (axis + 2) % 3] as const;
    const along = extent(points, axis);
    const first = positions.length / 3;
    for (let section = 0; section < sections; section++) {
      const share = section / (sections - 1);
      const at = along.min + share * (along.max - along.min);
      // The mesh's ends are round, so the sections are measured a little inside.
      const half = (0.6 * (along.max - along.min)) / (2 * (sections - 1));
      const near = points.filter((point) => Math.abs(point[axis]! - at) <= half);
      const [a, b] = [extent(near.length > 2 ? near : points, u), extent(near.length > 2 ? near : points, v)];
      for (let side = 0; side < sides; side++) {
        const angle = (2 * Math.PI * (side + 0.5)) / sides;
        const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
        const position = [0, 0, 0];
        position[axis] = at;
        position[u] = (a.min + a.max) / 2 + (circumradius * cos * (a.max - a.min)) / 2;
        position[v] = (b.min + b.max) / 2 + (circumradius * sin * (b.max - b.min)) / 2;
        positions.push(...position);
        const normal = [0, 0, 0];
        normal[u] = cos / (a.max - a.min || 1);
        normal[v] = sin / (b.max - b.min || 1);
        const length = Math.hypot(...normal);
        // Ends shine a little, like the round ones that they replace.
        normal[axis] = section === 0 ? -0.5 * length : section === sections - 1 ? 0.5 * length : 0;
        const whole = Math.hypot(...normal);
        normals.push(...normal.map((part) => part / whole));
        joints.push(JOINT[prism.joint], JOINT[prism.to ?? prism.joint]);
        blends.push(prism.to ? share : 0);
        tones.push(tone);
      }
    }
    const vertex = (section: number, side: number) => first + sides * section + (side % sides);
    for (let section = 0; section + 1 < sections; section++)
      for (let side = 0; side < sides; side++) {
        const [a, b, c, d] = [
          vertex(section, side),
          vertex(section, side + 1),
          vertex(section + 1, side + 1),
          vertex(section + 1, side),
        ];
        indices.push(a, b, c, a, c, d);
      }
    if (prism.open) continue;
    for (let side = 1; side + 1 < sides; side++) {
      indices.push(vertex(0, 0), vertex(0, side + 1), vertex(0, side));
      indices.push(vertex(sections - 1, 0), vertex(sections - 1, side), vertex(sections - 1, side + 1));
    }
  }
  return {
    positions: new Float32Array(positions),
    normals: new Float32Array(normals),
    joints: new Uint8Array(joints),
    blends: new Float32Array(blends),
    tones: new Uint8Array(tones),
    indices: new Uint16Array(indices),
  };
}

/** The vertices that a prism replaces. */
function verticesOf({ positions, joints, tones }: SkinnedBody, { joint, to, both, only }: Prism): number[][] {
  const points: number[][] = [];
  const followed = [JOINT[joint], ...(both && to ? [JOINT[to]] : [])];
  for (let vertex = 0; vertex < tones.length; vertex++)
    if (followed.includes(joints[2 * vertex]!) && (only === undefined || tones[vertex] === only))
      points.push([...positions.subarray(3 * vertex, 3 * vertex + 3)]);
  return points;
}

function extent(points: readonly number[][], axis: number): { min: number; max: number } {
  const values = points.map((point) => point[axis]!);
  return { min: Math.min(...values), max: Math.max(...values) };
}
