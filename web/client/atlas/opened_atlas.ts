/** Interface of an atlas that is open in the worker. */
import type { AtlasFacts, AtlasView, NearestInAtlas, PackedWindows } from "../../engine/atlas";
import type { CallOptions } from "../../engine/types";

export type { AtlasFacts, AtlasPart, AtlasView, NearestInAtlas, PackedWindows } from "../../engine/atlas";

/** All distances between a motion and a database: columns are frames of the motion at equal intervals, lines are windows. */
export interface OpenedAtlas extends Readonly<AtlasFacts> {
  /** Smallest D of each line in some columns, m², column after column. */
  draw(view: AtlasView, columns: Uint32Array, options?: CallOptions): Promise<Float32Array>;
  /** The nearest window of a line in a column. */
  nearest(view: AtlasView, column: number, line: number): Promise<NearestInAtlas>;
  /** Pose at a frame of a clip, aligned with a column of the motion as in the metric. */
  pose(column: number, clip: number, frame: number): Promise<Float32Array>;
  /** The database's windows for the GPU. */
  packed(view: AtlasView, options?: CallOptions): Promise<PackedWindows>;
  /** The motion's columns, in the same layout. */
  packedColumns(view: AtlasView, options?: CallOptions): Promise<PackedWindows>;
  /** Line of each packed window; the largest number for windows without a line. */
  lines(view: AtlasView, options?: CallOptions): Promise<Uint32Array>;
  dispose(): void;
}
