/** What the page and the crowd's worker say to each other. */
import type { FieldVertex, People, Place } from "../../engine/crowd/limits";

/** What a crowd is opened with. */
export interface CrowdStart {
  /** 1 to 1,000. */
  count: number;
  /** Of all that is drawn by lot, a whole number from 0; 1 if missing. */
  seed?: number;
  field?: readonly FieldVertex[];
  route?: readonly Place[];
}

/** What does not change. */
export interface CrowdFacts {
  styles: readonly string[];
  /** Offset of each joint from its parent in the T-pose, 21 × xyz, metres. */
  proportions: Float32Array;
  /** Ticks a second. */
  rateHz: number;
}

/** Everybody after a tick. Its arrays share a buffer, which goes back for another tick. */
export interface CrowdTick {
  count: number;
  /** Of the ground, metres. */
  radius: number;
  /** 21 × (x y z 0, rotation x y z w) a person, in the world. */
  joints: Float32Array;
  /** A byte a person and style: its weight, of 255. */
  weights: Uint8Array;
  /** Time of the worker that it took. */
  tickMs: number;
  /** Whether ticks are too slow: from the next one on there are half as many people. */
  halves: boolean;
}

/** The worker's calls; `open` is the first. */
export interface CrowdCalls {
  open(people: People, start: CrowdStart): Promise<CrowdFacts>;
  /** Goes on by a tick; a buffer that is large enough is used again. */
  tick(buffer: ArrayBuffer | undefined): Promise<CrowdTick>;
  setCount(count: number): Promise<void>;
  setField(vertices: readonly FieldVertex[]): Promise<void>;
  setRoute(points: readonly Place[]): Promise<void>;
  /** Bones that the joints lie on in place of the model's own. */
  setBones(offsets: Float32Array): Promise<void>;
  exportBvh(person: number, secs: number): Promise<string>;
}
