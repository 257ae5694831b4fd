/** What a crowd can be; apart from the crowd, as links are read where no crowd is. */

/** Most people of a crowd. */
export const MAX_CROWD = 1000;
/** Most vertices of a field. */
export const MAX_VERTICES = 12;
/** Most points of a route. */
export const MAX_ROUTE_POINTS = 64;

/** A style at a place of the ground: who comes near walks in it, and the average walk, or the neutral style of those who perform, fills up what is missing to 1. */
export interface FieldVertex {
  /** Name of the style. */
  style: string;
  /** Place, metres, −100 to 100. */
  x: number;
  z: number;
  /** Where it counts half, metres, 0.5 to 10. */
  reach: number;
  /** −1 (its opposite) to 2. */
  intensity: number;
}

/** Who walks: by the model of a `.strutwalk` file, or of the built-in walks. */
export interface Walkers {
  kind: "walkers";
  model?: Uint8Array;
}

/** What an engine recorded of a motion in every style of a database; see `../recording.ts`. */
export interface Recorded {
  styles: readonly string[];
  numbers: Float32Array;
}

/** Who performs a motion. */
export interface Performers {
  kind: "performers";
  recorded: Recorded;
}

/** Who is there. */
export type People = Walkers | Performers;

/** A place [x, z] on the ground, metres. */
export type Place = readonly [x: number, z: number];
