/** Draws an atlas: by the graphics processor where there is one and it works, else by the processor. */
import { isCancellation, type StrutError } from "../../engine/errors";
import { Graphics, type GraphicsFound } from "./graphics";
import type { AtlasPart, AtlasView, OpenedAtlas, PackedWindows } from "./opened_atlas";

/** Columns of one call, which the engine answers between two frames. */
const CALL_COLUMNS = 8;
/** The order in which the processor draws of every eight columns one. */
const PASSES = [0, 4, 2, 6, 1, 3, 5, 7];
/** Two losses of the graphics processor within so long leave the drawing to the processor, milliseconds. */
const SOON_MS = 60_000;

/** Some columns of a picture. */
export interface Columns {
  /** Number of each column. */
  columns: Uint32Array;
  /** Columns that each of them stands for until they come themselves. */
  width: number;
  /** Least D of each line, m², a column after the other; infinite where there is no window. */
  distances: Float32Array;
}

/** Who drew a picture. */
export interface Drawn {
  /** The graphics processor's name, empty where the browser does not tell; `undefined`: the processor drew. */
  by: string | undefined;
  /** Time that it took, milliseconds. */
  ms: number;
  /** Why the processor drew: there is no graphics processor, it stopped, or the database is too large for it. */
  without?: "absent" | "lost" | "refused";
}

/** Losses of the graphics processor during a visit. */
export class Losses {
  private last = Number.NEGATIVE_INFINITY;
  private gaveUp = false;

  constructor(private readonly now: () => number = () => performance.now()) {}

  /** Whether there were two so soon after each other that it is not asked again. */
  get isGivenUp(): boolean {
    return this.gaveUp;
  }

  add(): void {
    const now = this.now();
    this.gaveUp ||= now - this.last < SOON_MS;
    this.last = now;
  }
}

/** Of the page. */
const VISIT = new Losses();

/** What tests replace. */
export interface DrawingSurroundings {
  openGraphics?: typeof Graphics.open;
  losses?: Losses;
}

/** Draws pictures of one atlas, one at a time. */
export class AtlasDrawing {
  /** Of one part of the body. */
  private graphics: { part: AtlasPart; made: Graphics; columns: PackedWindows } | undefined;
  private readonly openGraphics: typeof Graphics.open;
  private readonly losses: Losses;

  /** @param found the graphics processor, if there is one */
  constructor(
    private readonly atlas: OpenedAtlas,
    private readonly found: GraphicsFound | undefined,
    { openGraphics = (...open) => Graphics.open(...open), losses = VISIT }: DrawingSurroundings = {},
  ) {
    this.openGraphics = openGraphics;
    this.losses = losses;
  }

  /** @throws StrutError `cancelled`, or what is wrong with the view */
  async draw(view: AtlasView, onColumns: (columns: Columns) => void, signal: AbortSignal): Promise<Drawn> {
    const began = performance.now();
    let without: Drawn["without"] = this.found ? "lost" : "absent";
    // A graphics processor that stopped is asked once for another device.
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
