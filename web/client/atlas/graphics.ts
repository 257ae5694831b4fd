/** The GPU that draws atlases, in a worker of its own. Nothing is loaded if there is no GPU. */
import type { PackedWindows } from "../../engine/atlas";
import type { WorkerPort } from "../rpc";
import { RpcClient } from "../rpc_client";
import type { GraphicsCalls } from "./graphics_protocol";

/**
 * Columns of the first slice, and the minimum and maximum number of columns of a slice. Each slice is one submission; the
 * browser draws between them.
 */
const SLICE = { first: 64, least: 32, most: 1024 };
/** Target duration of a slice, milliseconds. */
const SLICE_MS = 30;
/** Numbers of a column's rows, and words of its window. */
const [ROWS, WINDOW] = [300, 12];

/** A GPU that can be used. */
export interface GraphicsFound {
  /** Its name, if the browser reports it. */
  name: string;
}

/**
 * The visitor's GPU; `undefined` if there is none or it is emulated in software.
 * @param software whether software emulation is accepted, as in tests
 */
export async function findGraphics(software: boolean): Promise<GraphicsFound | undefined> {
  const gpu: GPU | undefined = navigator.gpu;
  const adapter = await gpu?.requestAdapter({ powerPreference: "high-performance" }).catch(() => null);
  if (!adapter || (adapter.info.isFallbackAdapter && !software)) return undefined;
  const { vendor, architecture, description } = adapter.info;
  return { name: description || [vendor, architecture].filter((word) => word !== "").join(" ") };
}

function spawnWorker(): WorkerPort {
  return new Worker(new URL("./graphics_worker.ts", import.meta.url), { type: "module", name: "strut graphics" });
}

/** Draws the windows of one database for one part of the body. */
export class Graphics {
  private readonly rpc: RpcClient<GraphicsCalls>;
  private columns = SLICE.first;

  private constructor(spawn: () => WorkerPort) {
    this.rpc = new RpcClient(spawn, "graphics processor");
  }

  /** @throws StrutError `gpu-lost` if it cannot be used */
  static async open(packed: PackedWindows, signal?: AbortSignal, spawn = spawnWorker): Promise<Graphics> {
    const graphics = new Graphics(spawn);
    try {
      const transfer = [packed.rows.buffer, packed.windows.buffer] as ArrayBuffer[];
      await graphics.rpc.call("open", [packed], { signal, transfer });
      return graphics;
    } catch (thrown) {
      graphics.dispose();
      throw thrown;
    }
  }

  /** Sets the line of each window, below `height`. @throws StrutError `gpu-lost` */
  setLines(lines: Uint32Array, height: number): Promise<void> {
    return this.rpc.call("setLines", [lines, height]);
  }

  /**
   * Draws all columns in slices.
   * @param onColumns receives the index of the first of some columns, and their D
   * @throws StrutError `gpu-lost`, or `cancelled`
   */
  async draw(
    { rows, windows }: PackedWindows,
    onColumns: (first: number, distances: Float32Array) => void,
    signal?: AbortSignal,
  ): Promise<void> {
    const count = windows.length / WINDOW;
    for (let first = 0; first < count; ) {
      const end = Math.min(count, first + this.columns);
      const slice = {
        rows: rows.slice(first * ROWS, end * ROWS),
        windows: windows.slice(first * WINDOW, end * WINDOW),
      };
      const began = performance.now();
      const bits = await this.rpc.call("draw", [slice], { signal });
      const share = SLICE_MS / Math.max(1, performance.now() - began);
      const wished = Math.round(((end - first) * Math.min(2, share)) / SLICE.least) * SLICE.least;
      this.columns = Math.min(SLICE.most, Math.max(SLICE.least, wished));
      onColumns(first, new Float32Array(bits.buffer));
      first = end;
    }
  }

  dispose(): void {
    this.rpc.dispose();
  }
}
