/** What the page and the graphics processor's worker say to each other. */
import type { PackedWindows } from "../../engine/atlas";

/** The worker's calls, which it answers one after the other; `open` is the first. */
export interface GraphicsCalls {
  /** Opens the fastest graphics processor with a database's windows; gives its name, empty where the browser does not tell. */
  open(packed: PackedWindows): Promise<string>;
  /** Line of each window, below `height`; the largest number for none. */
  setLines(lines: Uint32Array, height: number): Promise<void>;
  /** Bits of the least D of each line, a column after the other. */
  draw(columns: PackedWindows): Promise<Uint32Array>;
}
