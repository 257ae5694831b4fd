/** Messages between the page and a driven character. */
import type { MoveName } from "../../engine/drive/driver";
import type { StyleKey } from "../../engine/types";
import type { LiveFrame } from "../live_frame";

/** A move that can be requested of a character. */
export type Move = MoveName;

/** Steering input of the character. */
export interface DriveControl {
  /** Direction over the ground in the world, length 0 (stand) to 1. */
  readonly move: readonly [x: number, z: number];
  /** 0 stand, 1 walk, 2 run, and all values between. */
  readonly gait: number;
  /** Heading to face, radians about +Y from +Z to +X; if missing, the direction of {@link move}. */
  readonly face?: number;
  /** A path to follow from its beginning to its end instead, x and z of its points in metres; an empty one ends it. */
  readonly path?: Float32Array;
  /** A move to start. */
  readonly action?: Move;
}

/** Steering input for standing still. */
export const STILL: DriveControl = { move: [0, 0], gait: 1 };

/** A place on the ground and a heading about +Y. */
export type Root = readonly [x: number, z: number, heading: number];

/** Facts of the clips used for driving. */
export interface DriveInfo {
  /** Speeds of walking and running, m/s. */
  speeds: readonly [walk: number, run: number];
  /** Moves that the database contains. */
  moves: readonly Move[];
  /** Numbers of clips and frames to choose from, mirror images included. */
  clips: number;
  frames: number;
  /** A sentence if built-in clips are used for walking, because the database has too little; empty otherwise. */
  note: string;
}

/**
 * The displayed frame of a driven character. Its `inputPose` is the neutral one with its feet planted, and `inputFrame`
 * counts the driven frames.
 */
export interface DriveFrame extends LiveFrame {
  /** Position and heading of the neutral character's root. */
  root: Root;
  /** Root that the steering asks for after 1/3, 2/3 and 1 s: x, z and heading each. */
  asked: Float32Array;
  /** Root to which the playing clip would lead, in the same layout. */
  ahead: Float32Array;
  /** Speed over the ground, m/s. */
  speed: number;
  /** Name of the playing clip, and its row. */
  clip: string;
  row: number;
  /** Number of jumps to a row other than the next one, in the last second. */
  transitions: number;
  /** Distance covered along its path, metres; `undefined` without a path. */
  progress: number | undefined;
  /** The move in progress. */
  move: Move | undefined;
}

/** The recording of what was driven, at most the last five minutes. */
export interface Driven {
  /** The neutral motion as the text of a BVH file; empty if nothing was driven. */
  bvh: string;
  frames: number;
  /** The same motion as poses: a file does not contain the height of the hips. */
  poses: Float32Array;
  /** The styles in which it was displayed. */
  track: readonly StyleKey[];
}

/** Whether all numbers of a control are valid. */
export function isControl({ move, gait, face }: DriveControl): boolean {
  return [...move, gait, face ?? 0].every(Number.isFinite);
}
