/**
 * Resamples a performer's poses to a constant rate as they arrive, and computes the figure to display. Runs on the
 * calling thread.
 */
import { POSE_FLOATS } from "../../humanoid";
import { Handle } from "../handle";
import type { StreamSkeleton } from "./skeleton";
import { type LiveGlue, livePackage } from "./wasm";

type Raw = InstanceType<LiveGlue["Stream"]>;

/** Kinds of displayed frames, in the order of `Stream.advance` of `rust/strut-wasm/src/live/stream.rs`. */
export const PLAYS = ["nothing", "sent", "continued", "held", "lost"] as const;
/** Kind of a displayed frame. */
export type Play = (typeof PLAYS)[number];

/** Statistics of a stream. */
export interface BufferStats {
  /** Buffering delay of frames, seconds. */
  delaySecs: number;
  /** Time between two frames, seconds. */
  periodSecs: number;
  /** Frames that were accepted. */
  taken: number;
  /** Accepted frames that arrived too late. */
  late: number;
  /** Frames with the same time as another, or beyond 240 per second. */
  dropped: number;
  /** Frames that never arrived, according to the sender's times. */
  missing: number;
  /** Number of times that the performer was lost. */
  losses: number;
  /** Frames that were not valid poses. */
  refused: number;
}

/** Settings of a stream. */
interface PoseStreamSetup {
  /** The body of the database: 21 × xyz, metres. */
  proportions: Float32Array;
  rateHz: number;
  /** Buffering delay of frames, seconds; `undefined` adapts it to their jitter. */
  delaySecs: number | undefined;
  /** Whether the character is pulled to the performer's position, or moves freely with its own steps. */
  follows: boolean;
}

/** A stream of poses; see the module's documentation. Times are seconds. */
export class PoseStream extends Handle<Raw> {
  private constructor(raw: Raw) {
    super(raw, "stream");
  }

  /** @throws StrutError if the module cannot be loaded */
  static async open({ proportions, rateHz, delaySecs, follows }: PoseStreamSetup): Promise<PoseStream> {
    const glue = await livePackage.load();
    return livePackage.guarded(() => new PoseStream(new glue.Stream(proportions, rateHz, delaySecs, follows)));
  }

  /** @throws StrutError `bad-input` or `bad-file` if the skeleton is invalid; the previous one stays in use */
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
   * Accepts a frame with the sender's time and the time of arrival. Returns whether it is used.
   * @throws StrutError `bad-file` if the first frame of a BVH file shows that its skeleton is not a body
   */
  push(sentSecs: number, arrivedSecs: number, numbers: Float32Array): boolean {
    return livePackage.guarded(() => this.raw.push(sentSecs, arrivedSecs, numbers));
  }

  /**
   * Advances to a time, one frame after the last, and returns the kind of the displayed frame. The performer's pose is
   * written to `performer`.
   */
  advance(nowSecs: number, performer: Float32Array): Play {
    return livePackage.guarded(() => {
      const play = PLAYS[this.raw.advance(nowSecs)]!;
      this.raw.performer(performer);
      return play;
    });
  }

  /** Whether the frame of {@link advance} is not continuous with the one before. */
  get begins(): boolean {
    return livePackage.guarded(() => this.raw.begins());
  }

  /** Earliest time at which the frame of {@link advance} could have been displayed. */
  get dueSecs(): number {
    return livePackage.guarded(() => this.raw.dueSecs());
  }

  /** Sets whether planted feet are held from the next frame on. */
  set holdsFeet(holds: boolean) {
    livePackage.guarded(() => this.raw.holdFeet(holds));
  }

  /** Returns the displayed pose of a frame that {@link advance} returned and the engine styled. */
  show(styled: Float32Array, planted: ArrayLike<number>, performer: Float32Array, begins: boolean): Float32Array {
    const shown = new Float32Array(POSE_FLOATS);
    livePackage.guarded(() => {
      this.raw.show(styled, planted[0] === 1, planted[1] === 1, performer, begins);
      this.raw.shown(shown);
    });
    return shown;
  }

  /** Which feet are held in the pose that {@link show} returned. */
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
