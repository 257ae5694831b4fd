/** Live poses in a style: a source, the stream that it feeds, and frames at the database's rate. */
import type { EngineClient } from "../client/engine_client";
import type { ClientDatabase, StyleChange } from "../client/handles";
import { LiveStream } from "../client/live/live_stream";
import type { LiveStats, StreamFrame } from "../client/live/protocol";
import { type DatabaseInfo, isFault, type StyleWeights, type StylizeOptions } from "../client/protocol";
import { StrutError } from "../engine/errors";
import { bvhText } from "../formats/bvh";
import { POSE_FLOATS } from "../humanoid";
import type { PoseSink, PoseSource } from "./pose_source";

/** Longest recording, seconds. */
const MAX_RECORDED_SECS = 3600;

/** How a performer is styled. */
export interface LiveOptions extends Partial<StylizeOptions> {
  /** How long frames wait so that late ones come in time: as their jitter asks, or so many milliseconds, 0 to 200. */
  readonly delay?: "auto" | number;
  /** Whether the figure is drawn to the performer's place, or goes where its steps lead. */
  readonly place?: "follow" | "free";
}

/** A performer who is styled as poses arrive. */
export interface Live {
  /** Is called with every frame that is shown, at the database's rate; not while nothing comes. */
  onFrame: ((frame: StreamFrame) => void) | undefined;
  /** Called with a message when something does not work: no answer from the source, or data that is not a body. The stream continues. */
  onTrouble: ((sentence: string) => void) | undefined;
  /** How the stream goes. */
  readonly stats: LiveStats;
  /** Takes effect with the next frame. @throws StrutError `bad-input`, at once */
  setStyles(styles: StyleWeights, change?: StyleChange): void;
  /** Begins to keep what is shown, for an hour at most. */
  record(): LiveRecorder;
  /** Ends it, with its source. */
  close(): void;
}

/** A recording that goes on. */
export interface LiveRecorder {
  /** Ends the recording, and gives it. */
  stop(): LiveRecording;
}

/** What was shown, on the body of the database and at its rate; 87 numbers a frame. */
export interface LiveRecording {
  /** How many there are. */
  readonly frames: number;
  /** The styled poses. */
  readonly poses: Float32Array;
  /** The performer's poses. */
  readonly inputPoses: Float32Array;
  /** The text of a BVH file of the styled poses. */
  toBVH(): string;
  /** The text of a BVH file of the performer's poses. */
  inputToBVH(): string;
}

/** @throws StrutError where something cannot be loaded, or an option is wrong */
export async function openLive(
  engine: EngineClient,
  database: ClientDatabase,
  source: PoseSource,
  { delay = "auto", place = "follow", ...options }: LiveOptions = {},
): Promise<Live> {
  if (delay !== "auto" && !(delay >= 0 && delay <= MAX_DELAY_MS)) {
    const message = `delay is ${delay}; "auto", or 0 to ${MAX_DELAY_MS} ms was expected.`;
    throw new StrutError({ code: "bad-input", message, hint: "" });
  }
  const delaySecs = delay === "auto" ? undefined : delay / 1000;
  const stream = await LiveStream.open(engine, database, { delaySecs, follows: place === "follow", options });
  return new SourceLive(stream, source);
}

const MAX_DELAY_MS = 200;

class SourceLive implements Live {
  onFrame: ((frame: StreamFrame) => void) | undefined;
  onTrouble: ((sentence: string) => void) | undefined;
  readonly #stream: LiveStream;
  readonly #closing = new AbortController();
  readonly #recorders = new Set<Recorder>();

  constructor(stream: LiveStream, source: PoseSource) {
    this.#stream = stream;
    stream.onFrame = (frame) => {
      for (const recorder of this.#recorders) recorder.add(frame);
      this.onFrame?.(frame);
    };
    const { signal } = this.#closing;
    void this.#listen(source, signal);
    void this.#play(signal);
  }

  get stats(): LiveStats {
    return this.#stream.stats;
  }

  setStyles(styles: StyleWeights, { parts, halfLifeSecs }: StyleChange = {}): void {
    this.#stream.configure({ styles, ...(parts && { parts }) }, halfLifeSecs);
  }

  record(): LiveRecorder {
    const { info } = this.#stream.database;
    const recorder = new Recorder(info, (ended) => this.#recorders.delete(ended));
    this.#recorders.add(recorder);
    return recorder;
  }

  close(): void {
    this.#closing.abort();
    this.#recorders.clear();
    this.#stream.dispose();
  }

  async #listen(source: PoseSource, signal: AbortSignal): Promise<void> {
    // Whoever opened it first says what is to become of troubles.
    await new Promise((resolve) => setTimeout(resolve));
    if (!signal.aborted) await source.start(this.#sink(), signal).catch((thrown) => this.#trouble(thrown));
  }

  #sink(): PoseSink {
    const unlessClosed = (take: () => void) => {
      if (this.#closing.signal.aborted) return;
      try {
        take();
      } catch (thrown) {
        this.#trouble(thrown);
      }
    };
    return {
      skeleton: (skeleton) =>
        unlessClosed(() => {
          this.#stream.skeleton = skeleton;
        }),
      frame: (secs, pose) => unlessClosed(() => void this.#stream.push(secs, pose)),
      lost: (why) => unlessClosed(() => this.onTrouble?.(why)),
    };
  }

  async #play(signal: AbortSignal): Promise<void> {
    while (!signal.aborted) {
      try {
        await this.#stream.advance();
      } catch (thrown) {
        if (signal.aborted) return;
        this.#trouble(thrown);
        // Another engine takes the place of one that failed; what else is refused will be again.
        if (!isFault(thrown)) return;
      }
      await nextRepaint(1000 / this.#stream.database.info.rateHz);
      // With the engine, or its database, all that it feeds ends: an open loop would keep a program of Node running.
      if (this.#stream.closed) this.close();
    }
  }

  #trouble(thrown: unknown): void {
    if (!this.#closing.signal.aborted) this.onTrouble?.((thrown as Error).message);
  }
}

/** The next repaint of the browser, or, where there is none, a while later. */
function nextRepaint(ms: number): Promise<void> {
  return new Promise((resolve) => {
    if (typeof requestAnimationFrame === "function") requestAnimationFrame(() => resolve());
    else setTimeout(resolve, ms);
  });
}

class Recorder implements LiveRecorder {
  private readonly poses: Float32Array[] = [];
  private readonly inputPoses: Float32Array[] = [];

  constructor(
    private readonly database: DatabaseInfo,
    private readonly onStop: (recorder: Recorder) => void,
  ) {}

  add({ pose, inputPose }: StreamFrame): void {
    if (this.poses.length >= MAX_RECORDED_SECS * this.database.rateHz) return;
    this.poses.push(pose.slice());
    this.inputPoses.push(inputPose);
  }

  stop(): LiveRecording {
    this.onStop(this);
    const [poses, inputPoses] = [joined(this.poses), joined(this.inputPoses)];
    const { proportions, rateHz } = this.database;
    return {
      frames: this.poses.length,
      poses,
      inputPoses,
      toBVH: () => bvhText({ proportions, rateHz, poses }),
      inputToBVH: () => bvhText({ proportions, rateHz, poses: inputPoses }),
    };
  }
}

function joined(poses: readonly Float32Array[]): Float32Array {
  const all = new Float32Array(poses.length * POSE_FLOATS);
  for (const [i, pose] of poses.entries()) all.set(pose, i * POSE_FLOATS);
  return all;
}
