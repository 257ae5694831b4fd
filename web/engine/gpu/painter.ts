/** Draws the pictures of the atlas on the GPU, on the calling thread. */
import type { PackedWindows } from "../atlas";
import { Handle } from "../handle";
import type { Painter as RawPainter } from "./pkg/strut_wasm_gpu.js";
import { gpuPackage } from "./wasm";

/** Draws pictures of one database for one part of the body. */
export class Painter extends Handle<RawPainter> {
  private constructor(
    raw: RawPainter,
    /** Name of the GPU; empty if the browser does not report it. */
    readonly adapter: string,
  ) {
    super(raw, "painter");
  }

  /**
   * @throws StrutError `gpu-lost` if there is no GPU, or the windows do not fit its memory; `load` if the module cannot
   * be loaded
   */
  static async open({ rows, windows }: PackedWindows): Promise<Painter> {
    const glue = await gpuPackage.load();
    const raw = await gpuPackage.awaited(() => glue.Painter.open(rows, windows));
    return new Painter(raw, raw.adapter());
  }

  /**
   * Sets the line of each window, below `height`, or the largest number for windows without a line.
   * @throws StrutError `gpu-lost`
   */
  setLines(lines: Uint32Array, height: number): void {
    gpuPackage.guarded(() => this.raw.setLines(lines, height));
  }

  /** Bits of the smallest D of each line, column after column. @throws StrutError `gpu-lost` */
  draw({ rows, windows }: PackedWindows): Promise<Uint32Array> {
    return gpuPackage.awaited(() => this.raw.draw(rows, windows));
  }
}
