/** What an atlas that is open in the worker can be asked. */
import type { AtlasFacts, AtlasView, NearestInAtlas, PackedWindows } from "../../engine/atlas";
import type { CallOptions } from "../../engine/types";

export type { AtlasFacts, AtlasPart, AtlasView, NearestInAtlas, PackedWindows } from "../../engine/atlas";

/** Every distance between a motion and a database: columns are frames of the motion at even distances, lines are windows. */
export interface OpenedAtlas extends Readonly<AtlasFacts> {
  /** Least D of each line in some columns, m², a column after the other. */
  draw(view: AtlasView, columns: Uint32Array, options?: CallOptions): Promise<Float32Array>;
  /** The nearest window of a line in a column. */
  nearest(view: AtlasView, column: number, line: number): Promise<NearestInAtlas>;
  /** The pose at a frame of a clip as the metric has it nearest to a column of the motion. */
  pose(column: number, clip: number, frame: number): Promise<Float32Array>;
  /** The database's windows for a graphics processor. */
  packed(view: AtlasView, options?: CallOptions): Promise<PackedWindows>;
  /** The columns, in the same way. */
  packedColumns(view: AtlasView, options?: CallOptions): Promise<PackedWindows>;
  /** Line of each of the packed windows; the largest number for none. */
  lines(view: AtlasView, options?: CallOptions): Promise<Uint32Array>;
  dispose(): void;
}
