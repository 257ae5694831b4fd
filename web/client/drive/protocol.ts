/** What a page says to a driven character, and what comes back. */
import type { MoveName } from "../../engine/drive/driver";
import type { StyleKey } from "../../engine/types";
import type { LiveFrame } from "../live_frame";

/** A move that a character may be asked for. */
export type Move = MoveName;

/** What is asked of the character. */
export interface DriveControl {
  /** Over the ground in the world, of length 0 (stand) to 1. */
  readonly move: readonly [x: number, z: number];
  /** 0 stands, 1 walks, 2 runs, with all that is between. */
  readonly gait: number;
  /** Heading to face, radians about +Y from +Z to +X; the direction of {@link move} where it is missing. */
  readonly face?: number;
  /** A line to follow from its beginning to its end instead, x and z of its points in metres; an empty one ends it. */
  readonly path?: Float32Array;
  /** A move to begin. */
  readonly action?: Move;
}

/** What stands still. */
export const STILL: DriveControl = { move: [0, 0], gait: 1 };

/** A place on the ground and a heading about +Y. */
export type Root = readonly [x: number, z: number, heading: number];

/** What is driven with. */
export interface DriveInfo {
  /** Speeds of walking and running, m/s. */
  speeds: readonly [walk: number, run: number];
  /** Moves that the database has. */
  moves: readonly Move[];
  /** Clips and frames to choose from, mirror images included. */
  clips: number;
  frames: number;
  /** A sentence where built-in clips walk, as the database has too little walking; empty otherwise. */
  note: string;
}

/** What is on screen of a driven character; its `inputPose` is the neutral one
 * with its feet planted, and `inputFrame` counts the frames driven. */
export interface DriveFrame extends LiveFrame {
  /** Where the root of the neutral character is. */
  root: Root;
  /** Where it is asked to be after 1/3, 2/3 and 1 s: x, z and heading each. */
  asked: Float32Array;
  /** Where the clip that plays would take it, the same. */
  ahead: Float32Array;
  /** Over the ground, m/s. */
  speed: number;
  /** Name of the clip that plays, and its row. */
  clip: string;
  row: number;
  /** Changes to another row than the next one, in the last second. */
  transitions: number;
  /** How far along its path the character is, metres; `undefined` where it follows none. */
  progress: number | undefined;
  /** The move that it makes. */
  move: Move | undefined;
}

/** What was driven, the last five minutes of it at most. */
export interface Driven {
  /** The neutral motion as the text of a BVH file; empty if nothing was driven. */
  bvh: string;
  frames: number;
  /** The same as poses: a file does not hold the height of the hips. */
  poses: Float32Array;
  /** The styles that it was shown in. */
  track: readonly StyleKey[];
}

/** Whether a control has numbers only. */
export function isControl({ move, gait, face }: DriveControl): boolean {
  return [...move, gait, face ?? 0].every(Number.isFinite);
}
