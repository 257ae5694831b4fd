/** Limits of a crowd's parameters. They are separate from the crowd because links are read without a crowd. */

/** Maximum number of agents of a crowd. */
export const MAX_CROWD = 1000;
/** Maximum number of vertices of a field. */
export const MAX_VERTICES = 12;
/** Maximum number of points of a route. */
export const MAX_ROUTE_POINTS = 64;

/**
 * A style at a place of the ground. An agent that comes near takes on the style. The rest to a sum of 1 is the average
 * walk, or the neutral style for agents that perform a motion.
 */
export interface FieldVertex {
  /** Name of the style. */
  style: string;
  /** Place, metres, −100 to 100. */
  x: number;
  z: number;
  /** Distance at which the style counts half, metres, 0.5 to 10. */
  reach: number;
  /** Intensity, −1 (the opposite style) to 2. */
  intensity: number;
}

/** Agents that walk by the model of a `.strutwalk` file, or of the built-in walks. */
export interface Walkers {
  kind: "walkers";
  model?: Uint8Array;
}

/** A motion that the engine recorded in every style of a database; see `../recording.ts`. */
export interface Recorded {
  styles: readonly string[];
  numbers: Float32Array;
}

/** Agents that perform a motion. */
export interface Performers {
  kind: "performers";
  recorded: Recorded;
}

/** The agents of a crowd. */
export type People = Walkers | Performers;

/** A place [x, z] on the ground, metres. */
export type Place = readonly [x: number, z: number];
