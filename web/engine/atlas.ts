/** A picture of all distances between an input and a database, computed by the engine's own package. */
import type { Database } from "./database";
import { Handle } from "./handle";
import type { Input } from "./input";
import * as glue from "./pkg/strut_wasm.js";
import { guarded } from "./wasm";

/** Joints that an atlas compares. */
export const ATLAS_PARTS = ["whole", "legs", "arms", "torso", "head"] as const;
export type AtlasPart = (typeof ATLAS_PARTS)[number];

/** Part of a database that a picture shows. */
export interface AtlasView {
  part: AtlasPart;
  /** Index of the first window, by class and clip, and of the one after the last. */
  first: number;
  last: number;
  /** Number of lines, at most the number of windows. */
  height: number;
}

/** Properties of an atlas that do not change. */
export interface AtlasFacts {
  /** The input's frame of each column. */
  frames: Uint32Array;
  /** Index of the first window of each class, and the number of all windows. */
  firsts: Uint32Array;
}

/** Windows and their rows in the layout that the GPU reads (`strut-core/src/search/packed.rs`). */
export interface PackedWindows {
  rows: Float32Array;
  windows: Uint32Array;
}

/** The nearest window of a line in a column. */
export interface NearestInAtlas {
  /** Index of the window, by class and clip. */
  window: number;
  /** Index and name of its clip, and the window's last frame in that clip. */
  clip: number;
  name: string;
  frame: number;
  /** √D, metres. */
  distance: number;
}

/** The picture of an input in a database. */
export class Atlas extends Handle<glue.Atlas> {
  readonly facts: AtlasFacts;

  /** @param columns maximum number of columns; the picture shows frames of the input at equal intervals */
  constructor(database: Database, input: Input, columns: number) {
    const raw = guarded(() => new glue.Atlas(database.raw as glue.Database, input.raw as glue.Input, columns));
    super(raw, "atlas");
    this.facts = guarded(() => ({ frames: raw.frames(), firsts: raw.firsts() }));
  }

  /** Smallest D of each line in some columns, m², column after column. @throws StrutError `bad-input` */
  draw(view: AtlasView, columns: Uint32Array): Float32Array {
    return this.viewed(view, (raw) => raw.draw(columns));
  }

  /** @throws StrutError `bad-input` if the column or the line does not exist */
  nearest(view: AtlasView, column: number, line: number): NearestInAtlas {
    return this.viewed(view, (raw) => {
      const [window, clip, frame, distance] = raw.nearest(column, line) as unknown as [number, number, number, number];
      return { window, clip, name: raw.clipName(clip), frame, distance };
    });
  }

  /** Pose at a frame of a clip, aligned with a column of the input as in the metric. @throws StrutError `bad-input` */
  pose(column: number, clip: number, frame: number): Float32Array {
    return guarded(() => this.raw.pose(column, clip, frame));
  }

  /** The database's windows, by the joints of a view. */
  packed(view: AtlasView): PackedWindows {
    return this.viewed(view, (raw) => ({ rows: raw.packedRows(), windows: raw.packedWindows() }));
  }

  /** The input's columns, in the same layout. */
  packedColumns(view: AtlasView): PackedWindows {
    return this.viewed(view, (raw) => ({ rows: raw.packedColumnRows(), windows: raw.packedColumns() }));
  }

  /** Line of each packed window; the largest number for windows without a line. */
  packedLines(view: AtlasView): Uint32Array {
    return this.viewed(view, (raw) => raw.packedLines());
  }

  private viewed<T>({ part, first, last, height }: AtlasView, use: (raw: glue.Atlas) => T): T {
    return guarded(() => {
      this.raw.setView(ATLAS_PARTS.indexOf(part), first, last, height);
      return use(this.raw);
    });
  }
}
