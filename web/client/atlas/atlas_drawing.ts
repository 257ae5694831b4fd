/** Draws an atlas: on the GPU if there is one and it works, otherwise on the CPU. */
import { isCancellation, type StrutError } from "../../engine/errors";
import type { AtlasPart, AtlasView, ClientAtlas, PackedWindows } from "./client_atlas";
import { Graphics, type GraphicsFound } from "./graphics";

/** Columns per call, which the engine answers between two frames. */
const CALL_COLUMNS = 8;
/** The order in which the CPU draws one of every eight columns. */
const PASSES = [0, 4, 2, 6, 1, 3, 5, 7];
/** Two losses of the GPU within this time make the CPU draw from then on, milliseconds. */
const SOON_MS = 60_000;

/** Some columns of a picture. */
export interface Columns {
  /** Index of each column. */
  columns: Uint32Array;
  /** Number of columns that each of them fills until the others arrive. */
  width: number;
  /** Smallest D of each line, m², column after column; infinite for lines without a window. */
  distances: Float32Array;
}

/** What drew a picture. */
export interface Drawn {
  /** Name of the GPU, empty if the browser does not report it; `undefined` if the CPU drew. */
  by: string | undefined;
  /** Duration of the drawing, milliseconds. */
  ms: number;
  /** Why the CPU drew: there is no GPU, it was lost, or the database is too large for it. */
  without?: "absent" | "lost" | "refused";
}

/** Losses of the GPU during a visit. */
export class Losses {
  private last = Number.NEGATIVE_INFINITY;
  private gaveUp = false;

  constructor(private readonly now: () => number = () => performance.now()) {}

  /** Whether two losses were so close together that the GPU is not used again. */
  get isGivenUp(): boolean {
    return this.gaveUp;
  }

  add(): void {
    const now = this.now();
    this.gaveUp ||= now - this.last < SOON_MS;
    this.last = now;
  }
}

/** Losses of the page's visit. */
const VISIT = new Losses();

/** Dependencies that tests replace. */
interface DrawingSurroundings {
  openGraphics?: typeof Graphics.open;
  losses?: Losses;
}

/** Draws pictures of one atlas, one at a time. */
export class AtlasDrawing {
  /** The GPU's state for one part of the body. */
  private graphics: { part: AtlasPart; made: Graphics; columns: PackedWindows } | undefined;
  private readonly openGraphics: typeof Graphics.open;
  private readonly losses: Losses;

  /** @param found the GPU, if there is one */
  constructor(
    private readonly atlas: ClientAtlas,
    private readonly found: GraphicsFound | undefined,
    { openGraphics = (...open) => Graphics.open(...open), losses = VISIT }: DrawingSurroundings = {},
  ) {
    this.openGraphics = openGraphics;
    this.losses = losses;
  }

  /** @throws StrutError `cancelled`, or an error if the view is invalid */
  async draw(view: AtlasView, onColumns: (columns: Columns) => void, signal: AbortSignal): Promise<Drawn> {
    const began = performance.now();
    let without: Drawn["without"] = this.found ? "lost" : "absent";
    // After a loss of the GPU, another device is requested once.
    for (let attempt = 0; this.found && attempt < 2 && !this.losses.isGivenUp; attempt++) {
      try {
        return { by: this.found.name, ms: await this.drawByGraphics(view, onColumns, signal) };
      } catch (thrown) {
        if (isCancellation(thrown)) throw thrown;
        this.stop();
        if ((thrown as StrutError).code !== "bad-input") this.losses.add();
        else {
          without = "refused";
          break;
        }
      }
    }
    await this.drawByProcessor(view, onColumns, signal);
    return { by: undefined, ms: performance.now() - began, without };
  }

  dispose(): void {
    this.stop();
  }

  private stop(): void {
    this.graphics?.made.dispose();
    this.graphics = undefined;
  }

  private async drawByGraphics(
    view: AtlasView,
    onColumns: (columns: Columns) => void,
    signal: AbortSignal,
  ): Promise<number> {
    if (this.graphics?.part !== view.part) {
      this.stop();
      const made = await this.openGraphics(await this.atlas.packed(view, { signal }), signal);
      this.graphics = { part: view.part, made, columns: await this.atlas.packedColumns(view, { signal }) };
    }
    const { made, columns } = this.graphics;
    await made.setLines(await this.atlas.lines(view, { signal }), view.height);
    const began = performance.now();
    const take = (first: number, distances: Float32Array) => {
      const count = distances.length / view.height;
      onColumns({ columns: Uint32Array.from({ length: count }, (_, i) => first + i), width: 1, distances });
    };
    await made.draw(columns, take, signal);
    return performance.now() - began;
  }

  private async drawByProcessor(
    view: AtlasView,
    onColumns: (columns: Columns) => void,
    signal: AbortSignal,
  ): Promise<void> {
    const count = this.atlas.frames.length;
    for (const [pass, begin] of PASSES.entries()) {
      const width = pass === 0 ? 8 : pass === 1 ? 4 : pass < 4 ? 2 : 1;
      const of = Uint32Array.from({ length: Math.ceil(Math.max(0, count - begin) / 8) }, (_, i) => begin + 8 * i);
      for (let from = 0; from < of.length; from += CALL_COLUMNS) {
        const columns = of.slice(from, from + CALL_COLUMNS);
        onColumns({ columns, width, distances: await this.atlas.draw(view, columns, { signal }) });
      }
    }
  }
}
