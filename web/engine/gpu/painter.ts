/** Pictures of the atlas by the graphics processor, on the calling thread. */
import type { PackedWindows } from "../atlas";
import { Handle } from "../handle";
import type { Painter as RawPainter } from "./pkg/strut_wasm_gpu.js";
import { gpuPackage } from "./wasm";

/** Draws pictures of one database by one part of the body. */
export class Painter extends Handle<RawPainter> {
  private constructor(
    raw: RawPainter,
    /** Name of the graphics processor; empty where the browser does not tell. */
    readonly adapter: string,
  ) {
    super(raw, "painter");
  }

  /**
   * @throws StrutError `gpu-lost` if there is no graphics processor, or the windows do not fit it; `load` if the module cannot
   * be had
   */
  static async open({ rows, windows }: PackedWindows): Promise<Painter> {
    const glue = await gpuPackage.load();
    const raw = await gpuPackage.awaited(() => glue.Painter.open(rows, windows));
    return new Painter(raw, raw.adapter());
  }

  /** Takes the line of each window, below `height`, or the largest number for none. @throws StrutError `gpu-lost` */
  setLines(lines: Uint32Array, height: number): void {
    gpuPackage.guarded(() => this.raw.setLines(lines, height));
  }

  /** Bits of the least D of each line, a column after the other. @throws StrutError `gpu-lost` */
  draw({ rows, windows }: PackedWindows): Promise<Uint32Array> {
    return gpuPackage.awaited(() => this.raw.draw(rows, windows));
  }
}
