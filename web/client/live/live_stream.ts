/**
 * A performer styled as poses arrive: received poses wait on the calling thread until their time, are styled by the
 * engine in the worker, and return as displayed frames.
 */
import { isFault } from "../../engine/errors";
import { type Play, PoseStream } from "../../engine/live/pose_stream";
import type { StreamSkeleton } from "../../engine/live/skeleton";
import { POSE_FLOATS } from "../../humanoid";
import type { EngineClient } from "../engine_client";
import type { ClientDatabase, ClientStylizer } from "../handles";
import type { StylizeOptions } from "../protocol";
import { heaviest } from "../readings";
import type { LiveSetup, LiveStats, StreamFrame } from "./protocol";

/** Maximum number of frames that are caught up at once. If more time has passed, as in a hidden page, the rest is skipped. */
const MAX_FRAMES_AT_ONCE = 15;
/** Number of frames whose latency is kept. */
const REMEMBERED = 256;

/** Options for live poses: output lasts as long as input, and there is no timeline. */
const LIVE_OPTIONS = { timing: false, track: [] } as const;

export class LiveStream {
  /** Receives every displayed frame. */
  onFrame: ((frame: StreamFrame) => void) | undefined;
  readonly #rateHz: number;
  /** Time of the last frame, seconds. */
  #clockSecs: number | undefined;
  #play: Play = "nothing";
  #frames = 0;
  /** Whether the next frame is not continuous with the last, regardless of the stream's report. */
  #seam = false;
  #advancing: Promise<StreamFrame | undefined> | undefined;
  readonly #latencies: number[] = [];
  readonly #costs: number[] = [];

  private constructor(
    readonly database: ClientDatabase,
    private readonly stream: PoseStream,
    private readonly stylizer: ClientStylizer,
    private readonly nowSecs: () => number,
  ) {
    this.#rateHz = database.info.rateHz;
  }

  /**
   * @param nowSecs the clock of arrivals
   * @throws StrutError if something cannot be loaded, or an option is invalid
   */
  static async open(
    engine: EngineClient,
    database: ClientDatabase,
    { options, ...setup }: LiveSetup,
    nowSecs = () => performance.now() / 1000,
  ): Promise<LiveStream> {
    const { proportions, rateHz } = database.info;
    const stylizer = await engine.createStylizer(database, { ...options, ...LIVE_OPTIONS });
    try {
      const stream = await PoseStream.open({ proportions, rateHz, ...setup });
      stream.holdsFeet = options.footplant ?? true;
      return new LiveStream(database, stream, stylizer, nowSecs);
    } catch (thrown) {
      stylizer.dispose();
      throw thrown;
    }
  }

  /** Sets the skeleton of the next frames. @throws StrutError if it is invalid; the previous one stays in use */
  set skeleton(skeleton: StreamSkeleton) {
    this.stream.skeleton = skeleton;
  }

  /**
   * Accepts a frame that arrives now. Returns whether it is used.
   * @throws StrutError if the first frame of a BVH file shows that its skeleton is not a body
   */
  push(sentSecs: number, numbers: Float32Array): boolean {
    return this.stream.push(sentSecs, this.nowSecs(), numbers);
  }

  /** Takes effect with the next frame. @throws StrutError `bad-input`, at once */
  configure(change: Partial<StylizeOptions>, halfLifeSecs?: number): void {
    const { styles, parts, ...options } = { ...change, ...LIVE_OPTIONS };
    this.stylizer.configure(options);
    if (styles)
      this.stylizer.setStyles(styles, { ...(parts && { parts }), ...(halfLifeSecs !== undefined && { halfLifeSecs }) });
    if (change.footplant !== undefined) this.stream.holdsFeet = change.footplant;
  }

  /**
   * Advances to the current time: styles the frames that are due and returns the last of them. Returns `undefined` if
   * there is none, because nothing has arrived, the performer is lost, or it is too early. One call works at a time;
   * calls meanwhile get its answer.
   * @throws StrutError as from the engine; the next call continues
   */
  advance(): Promise<StreamFrame | undefined> {
    this.#advancing ??= this.#advance(this.nowSecs()).finally(() => {
      this.#advancing = undefined;
    });
    return this.#advancing;
  }

  /** Whether the engine has lost it. */
  get closed(): boolean {
    return this.stylizer.closed !== undefined;
  }

  get stats(): LiveStats {
    return {
      ...this.stream.stats,
      play: this.#play,
      frames: this.#frames,
      latencySecs: [quantile(this.#latencies, 0.5), quantile(this.#latencies, 0.95)],
      stylingSecs: quantile(this.#costs, 0.5),
    };
  }

  dispose(): void {
    this.stylizer.dispose();
    this.stream.dispose();
  }

  async #advance(nowSecs: number): Promise<StreamFrame | undefined> {
    let shown: StreamFrame | undefined;
    for (const batch of this.#due(nowSecs)) shown = await this.#styled(batch);
    return shown;
  }

  /** The performer's frames up to a time, in continuous batches. */
  #due(nowSecs: number): Batch[] {
    const step = 1 / this.#rateHz;
    let last = this.#clockSecs ?? nowSecs - step;
    if (nowSecs - last > MAX_FRAMES_AT_ONCE * step) {
      last = nowSecs - step;
      this.#seam = true;
    }
    // Rounded to the nearest frame: a screen with nearly the database's frame rate then shows one frame at a time.
    const count = Math.round((nowSecs - last) / step);
    this.#clockSecs = last + count * step;
    const batches: Batch[] = [];
    for (let i = 1; i <= count; i++) {
      const performer = new Float32Array(POSE_FLOATS);
      this.#play = this.stream.advance(last + i * step, performer);
      if (this.#play === "nothing" || this.#play === "lost") continue;
      const begins = this.stream.begins || this.#seam;
      this.#seam = false;
      if (begins || batches.length === 0) batches.push({ begins, frames: [] });
      batches.at(-1)!.frames.push({ performer, dueSecs: this.stream.dueSecs });
    }
    return batches;
  }

  async #styled({ begins, frames }: Batch): Promise<StreamFrame> {
    const poses = new Float32Array(frames.length * POSE_FLOATS);
    for (const [i, { performer }] of frames.entries()) poses.set(performer, i * POSE_FLOATS);
    if (begins) this.stylizer.reset();
    const askedSecs = this.nowSecs();
    try {
      const styled = await this.stylizer.push(poses);
      this.#remember(this.#costs, (this.nowSecs() - askedSecs) / frames.length);
      const reads = heaviest(this.database.info.classes, styled.classWeights);
      let shown: StreamFrame | undefined;
      for (const [i, { performer, dueSecs }] of frames.entries()) {
        const pose = styled.poses.subarray(i * POSE_FLOATS, (i + 1) * POSE_FLOATS);
        const planted = styled.planted.subarray(2 * i, 2 * i + 2);
        const seen = this.stream.show(pose, planted, performer, begins && i === 0);
        shown = { pose: seen, inputPose: performer, planted: this.stream.planted, reads, frame: this.#frames++ };
        this.#remember(this.#latencies, this.nowSecs() - dueSecs);
        this.onFrame?.(shown);
      }
      return shown!;
    } catch (thrown) {
      // Another engine does not know the frames before.
      this.#seam ||= begins || isFault(thrown);
      throw thrown;
    }
  }

  #remember(numbers: number[], secs: number): void {
    numbers.push(secs);
    if (numbers.length > REMEMBERED) numbers.shift();
  }
}

/** Consecutive frames of the performer; `begins` tells whether the first is not continuous with those before. */
interface Batch {
  begins: boolean;
  frames: { performer: Float32Array; dueSecs: number }[];
}

/** A quantile of numbers; 0 of an empty list. */
function quantile(numbers: readonly number[], share: number): number {
  const sorted = [...numbers].sort((a, b) => a - b);
  return sorted[Math.ceil(share * (sorted.length - 1))] ?? 0;
}
