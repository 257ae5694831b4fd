/** Neutral motion that follows steering, on the calling thread. A frame takes microseconds. */
import { POSE_FLOATS } from "../../humanoid";
import { assetOf } from "../assets";
import { inflatedAsset, type PackedMotions } from "../built_in";
import type { Database } from "../database";
import { StrutError } from "../errors";
import { Handle } from "../handle";
import { Input, type InputSource } from "../input";
import { guarded } from "../wasm";
import { type DriveGlue, drivePackage } from "./wasm";

/** Number of future instants in a frame: 1/3, 2/3 and 1 s ahead. */
export const AHEAD = 3;

/** Steering input of a frame. */
export interface Steering {
  /** Direction over the ground in the world, length 0 (stand) to 1. */
  move: readonly [x: number, z: number];
  /** 0 stand, 1 walk, 2 run. */
  gait: number;
  /** Heading to face, radians about +Y; if missing, the direction of `move`. */
  face?: number | undefined;
  /** A move to start. */
  action?: MoveName | undefined;
}

/** Moves, in the engine's order (`rust/strut-core/src/driving/moves.rs`). */
const MOVES = ["jump", "punch", "kick"] as const;
export type MoveName = (typeof MOVES)[number];

const TAKES = () => assetOf("drive.bin", () => new URL("../motions/drive.bin", import.meta.url));

// Offsets of the numbers in a frame: `rust/strut-wasm/src/drive/driver.rs`.
const ROOT = 2 * POSE_FLOATS;
const ASKED = ROOT + 3;
const CLIP_AHEAD = ASKED + 3 * AHEAD;
export const SPEED = CLIP_AHEAD + 3 * AHEAD;
const [ROW, CLIP, SWITCHED, ACTION, SHARE, FRAME] = [1, 2, 5, 6, 7, 8].map((after) => SPEED + after) as Six;
type Six = [number, number, number, number, number, number];

/** A frame of a driver, as a view of numbers that the next frame overwrites. */
export class DriverFrame {
  readonly numbers = new Float32Array(FRAME);
  /** The pose in the world. */
  readonly pose = this.numbers.subarray(0, POSE_FLOATS);
  /** The same pose with its feet planted, for display. */
  readonly planted = this.numbers.subarray(POSE_FLOATS, ROOT);
  /** Root: x, z in metres and heading in radians. */
  readonly root = this.numbers.subarray(ROOT, ASKED);
  /** The root positions that the steering asks for at the future instants, in the same layout. */
  readonly asked = this.numbers.subarray(ASKED, CLIP_AHEAD);
  /** The root positions to which the playing clip would lead. */
  readonly ahead = this.numbers.subarray(CLIP_AHEAD, SPEED);

  /** Speed over the ground, m/s. */
  get speed(): number {
    return this.numbers[SPEED]!;
  }

  get row(): number {
    return this.numbers[ROW]!;
  }

  /** Index into {@link Driver.clips}. */
  get clip(): number {
    return this.numbers[CLIP]!;
  }

  /** Whether this frame jumped to a row other than the next one. */
  get switched(): boolean {
    return this.numbers[SWITCHED] === 1;
  }

  /** The move that is playing. */
  get move(): MoveName | undefined {
    return MOVES[this.numbers[ACTION]! - 1];
  }

  /** How strongly the pose may be styled, 0 to 1. */
  get styleShare(): number {
    return this.numbers[SHARE]!;
  }
}

/** A driver over the neutral clips of a database. */
export class Driver extends Handle<InstanceType<DriveGlue["Driver"]>> {
  readonly frame = new DriverFrame();

  private constructor(
    raw: InstanceType<DriveGlue["Driver"]>,
    /** Names of the clips to choose from; the names of mirrored clips say so. */
    readonly clips: readonly string[],
    /** Number of rows to choose from. */
    readonly rows: number,
    /** Speeds of walking and running, m/s. */
    readonly speeds: readonly [walk: number, run: number],
    /** Moves that are available. */
    readonly moves: readonly MoveName[],
    /** A sentence if the fallback clips are used for walking; empty otherwise. */
    readonly note: string,
  ) {
    super(raw, "driver");
  }

  /**
   * @param takes see {@link loadTakes}
   * @param spare opens a fallback database, whose neutral walks are used if the first one has too little walking
   * @throws StrutError if the module or the fallback clips cannot be loaded
   */
  static async open(database: Database, takes: Database, spare: () => Promise<Database>): Promise<Driver> {
    const glue = await drivePackage.load();
    const { rateHz, proportions } = database.info;
    const clips = drivePackage.guarded(() => new glue.Clips(proportions, rateHz));
    const add = (among: number, of: Database): void => {
      const { proportions, rateHz } = of.info;
      for (const clip of neutralClips(of)) drivePackage.guarded(() => clips.add(among, ...clip, proportions, rateHz));
    };
    try {
      add(glue.Among.Own, database);
      add(glue.Among.Takes, takes);
      try {
        return Driver.over(glue, clips, "");
      } catch (thrown) {
        if (!(thrown instanceof StrutError && thrown.code === "bad-input")) throw thrown;
        const others = await spare();
        try {
          add(glue.Among.Spare, others);
        } finally {
          others.dispose();
        }
        return Driver.over(glue, clips, thrown.message);
      }
    } finally {
      clips.free();
    }
  }

  private static over(glue: DriveGlue, clips: InstanceType<DriveGlue["Clips"]>, note: string): Driver {
    return drivePackage.guarded(() => {
      const raw = new glue.Driver(clips);
      const mirrored = raw.mirrored();
      const names = raw.names().map((name, i) => (mirrored[i] ? `${name}, mirrored` : name));
      const [walk, run] = raw.speeds();
      const moves = MOVES.filter((move) => raw.moves().includes(move));
      return new Driver(raw, names, raw.rows(), [walk!, run!], moves, note);
    });
  }

  /**
   * The next frame, `1 / rateHz` after the last one. `styled` is the position of the styled character's hips in the
   * last frame.
   */
  next({ move, gait, face, action }: Steering, styled: readonly [x: number, z: number] | undefined): DriverFrame {
    drivePackage.guarded(() => {
      const asked = action && MOVES.indexOf(action);
      this.raw.next(move[0], move[1], gait, face, asked, styled?.[0], styled?.[1]);
      this.raw.read(this.frame.numbers);
    });
    return this.frame;
  }

  /** A path to follow, x and z of its points. Fewer than two distinct points end it. */
  set path(points: Float32Array) {
    drivePackage.guarded(() => this.raw.setPath(points));
  }

  /** Distance covered along the path, metres; `undefined` without a path or at its end. */
  get progress(): number | undefined {
    return drivePackage.guarded(() => (this.raw.hasArrived() ? undefined : this.raw.progress()));
  }

  /** Restarts at a place, without a path. */
  reset(x: number, z: number, heading: number): void {
    drivePackage.guarded(() => this.raw.reset(x, z, heading));
  }
}

/** Loads takes that a database may lack, as packed motions: standing, turns on the spot, halts, changes of gait. */
export function loadTakes(): Promise<PackedMotions> {
  return inflatedAsset(TAKES(), "driving");
}

/** The neutral clips of a database: name, action, poses, contacts. */
function* neutralClips({ raw }: Database): Generator<[string, string, Float32Array, Uint8Array]> {
  for (const clip of guarded(() => raw.neutralClips())) {
    const [name, action] = [guarded(() => raw.clipName(clip)), guarded(() => raw.clipAction(clip))];
    yield [name, action, guarded(() => raw.clipPoses(clip)), guarded(() => raw.clipContacts(clip))];
  }
}

/** The text of a BVH file with poses on the body of a database. */
export function bvhOfPoses({ raw }: Database, poses: Float32Array): string {
  return guarded(() => raw.bvhOfPoses(poses));
}

/** An input from poses on the body of a database and at its frame rate, unchanged. */
export function inputOfPoses(
  database: Database,
  source: Pick<InputSource, "kind" | "name">,
  poses: Float32Array,
): Input {
  return Input.of(
    guarded(() => database.raw.inputOfPoses(poses)),
    database,
    source,
  );
}
