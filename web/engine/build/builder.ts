/** Builds databases from labelled clips on the calling thread; the build worker runs it. */
import type { Building } from "./pkg/strut_wasm_build";
import { type BuildGlue, buildPackage } from "./wasm";

/** Labels of a file. */
export interface Labels {
  action: string;
  style: string;
  /** Number of the take; undefined to have it counted. */
  take: number | undefined;
}

/** The labels of a file, or why it has none. */
export type Labelled = Labels | { reason: string };

/** A file of a build. */
export interface BuildFile extends Labels {
  /** Path with `/`; for a file in an archive the archive's path, then the path in it. */
  path: string;
  /** Title of its licence, empty if unknown. */
  licence: string;
}

/** Joint of each of the 21 humanoid roles, −1 where there is none. */
export type Roles = Int32Array;

/** Properties of a clip before a build. */
export interface ClipInfo {
  frames: number;
  rateHz: number;
  /** Names of the joints, parents first, and the index of each one's parent, −1 for the root. */
  joints: string[];
  parents: Int32Array;
  roles: Roles;
  /** Confidence of the roles, 0 to 1. */
  confidence: number;
  /** Why the skeleton is no humanoid; empty if it is one. */
  fault: string;
  /** A sentence for people about the match of the skeletons, or empty. */
  note: string;
}

/** A clip on its own skeleton, to be previewed. */
export interface Preview extends ClipInfo {
  /** Bone offsets, 21 × xyz, metres; empty where the skeleton is no humanoid. */
  proportions: Float32Array;
  /** `frames` poses; empty where the skeleton is no humanoid. */
  poses: Float32Array;
}

/** A file that did not enter the database. */
export interface RefusedFile {
  path: string;
  reason: string;
}

/** A style that is performed in two manners in an action, with the paths of the clips of each. */
export interface TwoManners {
  action: string;
  style: string;
  paths: [string[], string[]];
}

/** A stage of {@link Build.step} and {@link Build.finish}. */
export type BuildStage = "preparing" | "registering" | "indexing";

/** Receives the progress of a stage. */
export type OnBuildProgress = (stage: BuildStage, done: number, total: number) => void;

/** A database that was built. */
export interface BuiltDatabase {
  /** The `.strutdb` file. */
  file: Blob;
  clips: number;
  frames: number;
  actions: string[];
  styles: string[];
  neutral: string;
  refused: RefusedFile[];
  /** Styles that styling takes to the mean of two manners. */
  twoManners: TwoManners[];
  /** Why the style of one clip may look wrong, a sentence; empty if nothing is known against it. */
  doubt: string;
}

/** Frames per second of databases. */
export const DATABASE_HZ = 60;

/** Builds databases. */
export class DatabaseBuilder {
  private constructor(private readonly glue: BuildGlue) {}

  /** @throws StrutError if the module cannot be had */
  static async load(): Promise<DatabaseBuilder> {
    return new DatabaseBuilder(await buildPackage.load());
  }

  /** The most likely pattern of these paths. */
  guessPattern(paths: string[]): string | undefined {
    return buildPackage.guarded(() => this.glue.guessPattern(paths));
  }

  /**
   * The labels of every path, from a table or else a pattern.
   * @throws StrutError with what is wrong with the pattern or the table
   */
  labelsOf(paths: string[], pattern: string | undefined, table: Uint8Array | undefined): Labelled[] {
    const flat = buildPackage.guarded(() => this.glue.labelsOf(paths, pattern, table));
    return paths.map((_, i) => {
      const [action, style, take, reason] = flat.slice(4 * i, 4 * i + 4) as [string, string, string, string];
      return reason ? { reason } : { action, style, take: take ? Number(take) : undefined };
    });
  }

  licenceTitle(text: Uint8Array): string {
    return buildPackage.guarded(() => this.glue.licenceTitle(text));
  }

  /** @throws StrutError with what is wrong with the file */
  inspect(bytes: Uint8Array, roles?: Roles): ClipInfo {
    const clip = buildPackage.guarded(() => new this.glue.Clip(bytes, roles));
    try {
      return buildPackage.guarded(() => infoOf(clip));
    } finally {
      clip.free();
    }
  }

  /** @throws StrutError with what is wrong with the file */
  preview(bytes: Uint8Array, roles?: Roles): Preview {
    const clip = buildPackage.guarded(() => new this.glue.Clip(bytes, roles));
    try {
      return buildPackage.guarded(() => {
        const info = infoOf(clip);
        const bound = info.fault === "";
        const none = new Float32Array();
        return { ...info, proportions: bound ? clip.proportions() : none, poses: bound ? clip.poses() : none };
      });
    } finally {
      clip.free();
    }
  }

  /**
   * A database with one more style, of one clip.
   * @param database a `.strutdb` file or packed motions
   * @param action what the clip shows, as a person says; without it the action that it fits best
   * @throws StrutError with why the clip is no style of it
   */
  addStyle(database: Uint8Array, path: string, style: string, bvh: Uint8Array, action?: string): BuiltDatabase {
    return databaseOf(buildPackage.guarded(() => this.glue.addStyle(database, path, style, bvh, action)));
  }

  /** Begins a build; without `neutral` that style is found by its name. */
  begin(files: readonly BuildFile[], neutral: string | undefined): Build {
    return new Build(this.glue, files, neutral);
  }
}

/** A build: files are added one at a time, then it runs in steps. */
export class Build {
  /** Paths in the order in which they must be added. */
  readonly order: string[];
  private raw: InstanceType<BuildGlue["Builder"]> | Building;

  constructor(
    private readonly glue: BuildGlue,
    files: readonly BuildFile[],
    neutral: string | undefined,
  ) {
    const builder = buildPackage.guarded(
      () =>
        new glue.Builder(
          files.map((f) => f.path),
          files.map((f) => f.action),
          files.map((f) => f.style),
          Int32Array.from(files, (f) => f.take ?? -1),
          files.map((f) => f.licence),
          neutral,
        ),
    );
    this.raw = builder;
    this.order = buildPackage.guarded(() => builder.order());
  }

  /** @throws StrutError with why the file cannot be used; the others can still be built without it */
  add(path: string, bytes: Uint8Array, roles?: Roles): void {
    const { raw } = this;
    if (raw instanceof this.glue.Builder) buildPackage.guarded(() => raw.add(path, bytes, roles));
  }

  /**
   * Processes a few clips, once all files were added; false when only {@link finish} is left.
   * @throws StrutError if nothing can be built from them
   */
  step(onProgress: OnBuildProgress): boolean {
    return buildPackage.guarded(() => this.building().step({ progress: onProgress }));
  }

  /**
   * The database of the files that were added; this object cannot be used afterwards.
   * @throws StrutError if nothing could be built
   */
  finish(onProgress: OnBuildProgress): BuiltDatabase {
    return databaseOf(buildPackage.guarded(() => this.building().finish({ progress: onProgress })));
  }

  /** Abandons the build. */
  dispose(): void {
    this.raw.free();
  }

  private building(): Building {
    const { raw } = this;
    const building = raw instanceof this.glue.Builder ? raw.begin(DATABASE_HZ) : raw;
    this.raw = building;
    return building;
  }
}

/** Takes the result out of the module and frees it there. */
function databaseOf(built: ReturnType<BuildGlue["addStyle"]>): BuiltDatabase {
  try {
    return buildPackage.guarded(() => {
      const refused = built.refused();
      return {
        file: new Blob([built.takeFile() as Uint8Array<ArrayBuffer>]),
        clips: built.clips(),
        frames: built.frames(),
        actions: built.actions(),
        styles: built.styles(),
        neutral: built.neutral(),
        refused: Array.from({ length: refused.length / 2 }, (_, i) => ({
          path: refused[2 * i]!,
          reason: refused[2 * i + 1]!,
        })),
        twoManners: twoMannersOf(built.twoManners()),
        doubt: built.doubt(),
      };
    });
  } finally {
    built.free();
  }
}

/** Styles from the action, style, manner and path of each of their clips. */
function twoMannersOf(flat: readonly string[]): TwoManners[] {
  const found: TwoManners[] = [];
  for (let i = 0; i < flat.length; i += 4) {
    const [action, style, manner, path] = flat.slice(i, i + 4) as [string, string, "0" | "1", string];
    let last = found.at(-1);
    if (last?.action !== action || last.style !== style) {
      last = { action, style, paths: [[], []] };
      found.push(last);
    }
    last.paths[manner].push(path);
  }
  return found;
}

function infoOf(clip: InstanceType<BuildGlue["Clip"]>): ClipInfo {
  return {
    frames: clip.frames(),
    rateHz: clip.rateHz(),
    joints: clip.joints(),
    parents: clip.parents(),
    roles: clip.roles(),
    confidence: clip.confidence(),
    fault: clip.fault(),
    note: clip.note(),
  };
}
