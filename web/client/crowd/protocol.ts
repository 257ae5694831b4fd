/** Messages between the page and the crowd's worker. */
import type { FieldVertex, People, Place } from "../../engine/crowd/limits";

/** Initial settings of a crowd. */
export interface CrowdStart {
  /** Number of agents, 1 to 1,000. */
  count: number;
  /** Seed of all random choices, a whole number from 0; 1 if missing. */
  seed?: number;
  field?: readonly FieldVertex[];
  route?: readonly Place[];
}

/** Properties of a crowd that do not change. */
export interface CrowdFacts {
  styles: readonly string[];
  /** Offset of each joint from its parent in the T-pose, 21 × xyz, metres. */
  proportions: Float32Array;
  /** Ticks per second. */
  rateHz: number;
}

/** All agents after a tick. Its arrays share a buffer, which is returned for another tick. */
export interface CrowdTick {
  count: number;
  /** Radius of the ground, metres. */
  radius: number;
  /** 21 × (x y z 0, rotation x y z w) per agent, in the world. */
  joints: Float32Array;
  /** One byte per agent and style: its weight, 0 to 255. */
  weights: Uint8Array;
  /** Computation time in the worker, milliseconds. */
  tickMs: number;
  /** Whether ticks are too slow: from the next one on the number of agents is halved. */
  halves: boolean;
}

/** The worker's calls; `open` is the first. */
export interface CrowdCalls {
  open(people: People, start: CrowdStart): Promise<CrowdFacts>;
  /** Advances by a tick. A buffer that is large enough is reused. */
  tick(buffer: ArrayBuffer | undefined): Promise<CrowdTick>;
  setCount(count: number): Promise<void>;
  setField(vertices: readonly FieldVertex[]): Promise<void>;
  setRoute(points: readonly Place[]): Promise<void>;
  /** Sets the bones on which the joints are placed, instead of the model's own. */
  setBones(offsets: Float32Array): Promise<void>;
  exportBvh(person: number, secs: number): Promise<string>;
}
