/** Neutral motion that goes where it is steered, on the calling thread: a frame takes microseconds. */
import { POSE_FLOATS } from "../../humanoid";
import { assetOf } from "../assets";
import { inflatedAsset, type PackedMotions } from "../built_in";
import type { Database } from "../database";
import { StrutError } from "../errors";
import { Handle } from "../handle";
import { Input, type InputSource } from "../input";
import { guarded } from "../wasm";
import { type DriveGlue, drivePackage } from "./wasm";

/** Instants ahead that a frame names: 1/3, 2/3 and 1 s. */
export const AHEAD = 3;

/** What is asked of a driver for a frame. */
export interface Steering {
  /** Over the ground in the world, of length 0 (stand) to 1. */
  move: readonly [x: number, z: number];
  /** 0 stands, 1 walks, 2 runs. */
  gait: number;
  /** Heading to face, radians about +Y; the direction of `move` where it is missing. */
  face?: number | undefined;
  /** A move to begin. */
  action?: MoveName | undefined;
}

/** Moves, in the engine's order (`rust/strut-core/src/driving/moves.rs`). */
export const MOVES = ["jump", "punch", "kick"] as const;
export type MoveName = (typeof MOVES)[number];

const TAKES = () => assetOf("drive.bin", () => new URL("../motions/drive.bin", import.meta.url));

// Where the numbers of a frame are: `rust/strut-wasm-drive/src/driver.rs`.
const ROOT = 2 * POSE_FLOATS;
const ASKED = ROOT + 3;
const CLIP_AHEAD = ASKED + 3 * AHEAD;
export const SPEED = CLIP_AHEAD + 3 * AHEAD;
const [ROW, CLIP, SWITCHED, ACTION, SHARE, FRAME] = [1, 2, 5, 6, 7, 8].map((after) => SPEED + after) as Six;
type Six = [number, number, number, number, number, number];

/** A frame of a driver, as a view of numbers that the next frame overwrites. */
export class DriverFrame {
  readonly numbers = new Float32Array(FRAME);
  /** In the world. */
  readonly pose = this.numbers.subarray(0, POSE_FLOATS);
  /** The same with its feet planted: what is shown of it. */
  readonly planted = this.numbers.subarray(POSE_FLOATS, ROOT);
  /** x, z in metres and heading in radians. */
  readonly root = this.numbers.subarray(ROOT, ASKED);
  /** Where the root is asked to be, three times the same. */
  readonly asked = this.numbers.subarray(ASKED, CLIP_AHEAD);
  /** Where the clip that plays would take it. */
  readonly ahead = this.numbers.subarray(CLIP_AHEAD, SPEED);

  /** Over the ground, m/s. */
  get speed(): number {
    return this.numbers[SPEED]!;
  }

  get row(): number {
    return this.numbers[ROW]!;
  }

  /** Number among {@link Driver.clips}. */
  get clip(): number {
    return this.numbers[CLIP]!;
  }

  /** Whether another row than the next one was taken. */
  get switched(): boolean {
    return this.numbers[SWITCHED] === 1;
  }

  /** The move that plays. */
  get move(): MoveName | undefined {
    return MOVES[this.numbers[ACTION]! - 1];
  }

  /** How far the pose may be styled, 0 to 1. */
  get styleShare(): number {
    return this.numbers[SHARE]!;
  }
}

/** A driver over the neutral clips of a database. */
export class Driver extends Handle<InstanceType<DriveGlue["Driver"]>> {
  readonly frame = new DriverFrame();

  private constructor(
    raw: InstanceType<DriveGlue["Driver"]>,
    /** Names of the clips to choose from; those that are mirrored say so. */
    readonly clips: readonly string[],
    /** Rows to choose from. */
    readonly rows: number,
    /** Speeds of walking and running, m/s. */
    readonly speeds: readonly [walk: number, run: number],
    /** Moves that can be asked for. */
    readonly moves: readonly MoveName[],
    /** A sentence where clips that were to spare walk; empty otherwise. */
    readonly note: string,
  ) {
    super(raw, "driver");
  }

  /**
   * @param takes see {@link loadTakes}
   * @param spare opens a database whose neutral clips walk where the first one has too little walking
   * @throws StrutError if the module or the spare clips cannot be had
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

  /** The next frame, `1 / rateHz` after the last; `styled` is where the styled character's hips were in it. */
  next({ move, gait, face, action }: Steering, styled: readonly [x: number, z: number] | undefined): DriverFrame {
    drivePackage.guarded(() => {
      const asked = action && MOVES.indexOf(action);
      this.raw.next(move[0], move[1], gait, face, asked, styled?.[0], styled?.[1]);
      this.raw.read(this.frame.numbers);
    });
    return this.frame;
  }

  /** A line to follow, x and z of its points; fewer than two distinct ones end it. */
  set path(points: Float32Array) {
    drivePackage.guarded(() => this.raw.setPath(points));
  }

  /** How far along the path the character is, metres; `undefined` where it has none, or has come to its end. */
  get progress(): number | undefined {
    return drivePackage.guarded(() => (this.raw.hasArrived() ? undefined : this.raw.progress()));
  }

  /** Begins anew at a place, without a path. */
  reset(x: number, z: number, heading: number): void {
    drivePackage.guarded(() => this.raw.reset(x, z, heading));
  }
}

/** Takes that a database may lack, as packed motions: standing, turns on the spot, halts, changes of gait. */
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

/** The text of a BVH file of poses on the body of a database. */
export function bvhOfPoses({ raw }: Database, poses: Float32Array): string {
  return guarded(() => raw.bvhOfPoses(poses));
}

/** An input of poses on the body of a database and at its rate, as they are. */
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
