/** A performer's poses as they arrive, evenly in time, and the figure that is shown of them; on the calling thread. */
import { POSE_FLOATS } from "../../humanoid";
import { Handle } from "../handle";
import type { StreamSkeleton } from "./skeleton";
import { type LiveGlue, livePackage } from "./wasm";

type Raw = InstanceType<LiveGlue["Stream"]>;

/** What is shown, in the order of `Stream.advance` of `rust/strut-wasm-live/src/stream.rs`. */
export const PLAYS = ["nothing", "sent", "continued", "held", "lost"] as const;
/** What is shown in a frame. */
export type Play = (typeof PLAYS)[number];

/** How a stream goes. */
export interface BufferStats {
  /** How long frames wait, seconds. */
  delaySecs: number;
  /** Time between two frames, seconds. */
  periodSecs: number;
  /** Frames that were taken. */
  taken: number;
  /** Those of them that came after their time. */
  late: number;
  /** Frames of the same time as another, or beyond 240 a second. */
  dropped: number;
  /** Frames that never came, by the sender's times. */
  missing: number;
  /** Times that the performer was lost. */
  losses: number;
  /** Frames that were no poses. */
  refused: number;
}

/** What a stream is made for. */
export interface PoseStreamSetup {
  /** The body of the database: 21 × xyz, metres. */
  proportions: Float32Array;
  rateHz: number;
  /** How long frames wait, seconds; `undefined`: as long as their jitter asks. */
  delaySecs: number | undefined;
  /** Whether the figure is drawn to the performer's place, or goes where its steps lead. */
  follows: boolean;
}

/** See the module's documentation. Times are seconds. */
export class PoseStream extends Handle<Raw> {
  private constructor(raw: Raw) {
    super(raw, "stream");
  }

  /** @throws StrutError if the module cannot be had */
  static async open({ proportions, rateHz, delaySecs, follows }: PoseStreamSetup): Promise<PoseStream> {
    const glue = await livePackage.load();
    return livePackage.guarded(() => new PoseStream(new glue.Stream(proportions, rateHz, delaySecs, follows)));
  }

  /** @throws StrutError `bad-input` or `bad-file` where it is none, and the one before stays */
  set skeleton(skeleton: StreamSkeleton) {
    livePackage.guarded(() => {
      if (skeleton.kind === "humanoid") this.raw.takePoses();
      else if (skeleton.kind === "bvh") this.raw.takeBvh(skeleton.header);
      else if (skeleton.kind === "landmarks") this.raw.takeLandmarks(skeleton.mirrored);
      else {
        const { names, parents, offsets, unit } = skeleton;
        this.raw.takeJoints([...names], Int32Array.from(parents), Float32Array.from(offsets), unit);
      }
    });
  }

  /**
   * Takes a frame that was sent at a time of the sender's and arrived at another; whether it is used.
   * @throws StrutError `bad-file` if the first frame of a BVH file shows that it is no body's
   */
  push(sentSecs: number, arrivedSecs: number, numbers: Float32Array): boolean {
    return livePackage.guarded(() => this.raw.push(sentSecs, arrivedSecs, numbers));
  }

  /** Goes on to a time, a frame after the last, and gives what is shown then; the performer's pose is written to `performer`. */
  advance(nowSecs: number, performer: Float32Array): Play {
    return livePackage.guarded(() => {
      const play = PLAYS[this.raw.advance(nowSecs)]!;
      this.raw.performer(performer);
      return play;
    });
  }

  /** Whether what {@link advance} gave is not continuous with what was shown before. */
  get begins(): boolean {
    return livePackage.guarded(() => this.raw.begins());
  }

  /** When what {@link advance} gave could have been shown at the earliest. */
  get dueSecs(): number {
    return livePackage.guarded(() => this.raw.dueSecs());
  }

  /** Whether planted feet are held from the next frame on. */
  set holdsFeet(holds: boolean) {
    livePackage.guarded(() => this.raw.holdFeet(holds));
  }

  /** What is seen of a frame that {@link advance} gave and the engine styled. */
  show(styled: Float32Array, planted: ArrayLike<number>, performer: Float32Array, begins: boolean): Float32Array {
    const shown = new Float32Array(POSE_FLOATS);
    livePackage.guarded(() => {
      this.raw.show(styled, planted[0] === 1, planted[1] === 1, performer, begins);
      this.raw.shown(shown);
    });
    return shown;
  }

  /** Which feet are held in what {@link show} gave. */
  get planted(): [left: boolean, right: boolean] {
    const [left, right] = livePackage.guarded(() => this.raw.planted());
    return [left === 1, right === 1];
  }

  get stats(): BufferStats {
    const [delaySecs, periodSecs, taken, late, dropped, missing, losses, refused] = livePackage.guarded(() =>
      this.raw.stats(),
    ) as unknown as Eight;
    return { delaySecs, periodSecs, taken, late, dropped, missing, losses, refused };
  }
}

type Eight = [number, number, number, number, number, number, number, number];
