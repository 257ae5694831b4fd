/** Messages between the page and the GPU's worker. */
import type { PackedWindows } from "../../engine/atlas";

/** The worker's calls, which it answers one after another; `open` is the first. */
export interface GraphicsCalls {
  /** Opens the fastest GPU with a database's windows. Returns its name, empty if the browser does not report it. */
  open(packed: PackedWindows): Promise<string>;
  /** Sets the line of each window, below `height`; the largest number for windows without a line. */
  setLines(lines: Uint32Array, height: number): Promise<void>;
  /** Bits of the smallest D of each line, column after column. */
  draw(columns: PackedWindows): Promise<Uint32Array>;
}
