/** Builds databases from labelled clips on the calling thread. The build worker runs it. */
import type { Building } from "./pkg/strut_wasm_build";
import { type BuildGlue, buildPackage } from "./wasm";

/** Labels of a file. */
export interface Labels {
  action: string;
  style: string;
  /** Number of the take; `undefined` numbers it automatically. */
  take: number | undefined;
}

/** The labels of a file, or the reason why it has none. */
export type Labelled = Labels | { reason: string };

/** A file to build a database from. */
export interface BuildFile extends Labels {
  /** Path with `/`; for a file in an archive, the archive's path, then the path in the archive. */
  path: string;
  /** Title of its licence, empty if unknown. */
  licence: string;
}

/** Joint of each of the 21 humanoid roles, −1 for a role without a joint. */
export type Roles = Int32Array;

/** Properties of a clip before a build. */
export interface ClipInfo {
  frames: number;
  rateHz: number;
  /** Names of the joints, parents first, and the index of each joint's parent, −1 for the root. */
  joints: string[];
  parents: Int32Array;
  roles: Roles;
  /** Confidence of the roles, 0 to 1. */
  confidence: number;
  /** Why the skeleton is not a humanoid; empty if it is one. */
  fault: string;
  /** A sentence for the user about the joint mapping, or empty. */
  note: string;
}

/** A clip on its own skeleton, for the preview. */
export interface Preview extends ClipInfo {
  /** Bone offsets, 21 × xyz, metres; empty if the skeleton is not a humanoid. */
  proportions: Float32Array;
  /** `frames` poses; empty if the skeleton is not a humanoid. */
  poses: Float32Array;
}

/** A file that was not used in the database. */
export interface RefusedFile {
  path: string;
  reason: string;
}

/** A bimodal style: its clips of an action form two clusters. Holds the paths of the clips of each cluster. */
export interface TwoManners {
  action: string;
  style: string;
  paths: [string[], string[]];
}

/** A stage of {@link Build.step} and {@link Build.finish}. */
type BuildStage = "preparing" | "registering" | "indexing";

/** Receives the progress of a stage. */
export type OnBuildProgress = (stage: BuildStage, done: number, total: number) => void;

/** A finished database. */
export interface BuiltDatabase {
  /** The `.strutdb` file. */
  file: Blob;
  clips: number;
  frames: number;
  actions: string[];
  styles: string[];
  neutral: string;
  refused: RefusedFile[];
  /** Bimodal styles: styling produces the mean of the two clusters. */
  twoManners: TwoManners[];
  /** A sentence on why the style of a single clip may look wrong; empty if no reason is known. */
  doubt: string;
}

/** Frames per second of databases. */
const DATABASE_HZ = 60;

/** Builds databases. */
export class DatabaseBuilder {
  private constructor(private readonly glue: BuildGlue) {}

  /** @throws StrutError if the module cannot be loaded */
  static async load(): Promise<DatabaseBuilder> {
    return new DatabaseBuilder(await buildPackage.load());
  }

  /** The most likely pattern of the labels in these paths. */
  guessPattern(paths: string[]): string | undefined {
    return buildPackage.guarded(() => this.glue.guessPattern(paths));
  }

  /**
   * The labels of every path, from the table or, without one, from the pattern.
   * @throws StrutError if the pattern or the table is invalid; the message says why
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

  /** @throws StrutError if the file is invalid; the message says why */
  inspect(bytes: Uint8Array, roles?: Roles): ClipInfo {
    const clip = buildPackage.guarded(() => new this.glue.Clip(bytes, roles));
    try {
      return buildPackage.guarded(() => infoOf(clip));
    } finally {
      clip.free();
    }
  }

  /** @throws StrutError if the file is invalid; the message says why */
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
   * Adds a style from one clip to a database.
   * @param database a `.strutdb` file or packed motions
   * @param action the action that the clip shows, as the user labels it; without it, the action that fits the clip best
   * @throws StrutError if the clip cannot become a style of the database; the message says why
   */
  addStyle(database: Uint8Array, path: string, style: string, bvh: Uint8Array, action?: string): BuiltDatabase {
    return databaseOf(buildPackage.guarded(() => this.glue.addStyle(database, path, style, bvh, action)));
  }

  /** Begins a build. Without `neutral`, the neutral style is found by its name. */
  begin(files: readonly BuildFile[], neutral: string | undefined): Build {
    return new Build(this.glue, files, neutral);
  }
}

/** A build: files are added one at a time, then the build runs in steps. */
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

  /** @throws StrutError if the file cannot be used; the message says why. The other files can still be built without it */
  add(path: string, bytes: Uint8Array, roles?: Roles): void {
    const { raw } = this;
    if (raw instanceof this.glue.Builder) buildPackage.guarded(() => raw.add(path, bytes, roles));
  }

  /**
   * Processes a few clips, after all files were added. Returns false when only {@link finish} is left.
   * @throws StrutError if nothing can be built from the files
   */
  step(onProgress: OnBuildProgress): boolean {
    return buildPackage.guarded(() => this.building().step({ progress: onProgress }));
  }

  /**
   * Returns the database of the files that were added. This object cannot be used afterwards.
   * @throws StrutError if nothing could be built
   */
  finish(onProgress: OnBuildProgress): BuiltDatabase {
    return databaseOf(buildPackage.guarded(() => this.building().finish({ progress: onProgress })));
  }

  /** Cancels the build. */
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

/** Copies the result out of the module and frees it there. */
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

/** Bimodal styles from the action, style, cluster and path of each of their clips. */
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
