/** Live poses in a style: a source, the stream that it feeds, and frames at the database's rate. */
import type { EngineClient } from "../client/engine_client";
import type { ClientDatabase, StyleChange } from "../client/handles";
import { LiveStream } from "../client/live/live_stream";
import type { LiveStats, StreamFrame } from "../client/live/protocol";
import { type DatabaseInfo, isFault, type StyleWeights, type StylizeOptions } from "../client/protocol";
import { abortable } from "../client/rpc";
import { StrutError } from "../engine/errors";
import { bvhText } from "../formats/bvh";
import { POSE_FLOATS } from "../humanoid";
import type { PoseSink, PoseSource } from "./pose_source";

/** Longest recording, seconds. */
const MAX_RECORDED_SECS = 3600;

/** Options of styling a live performer. */
export interface LiveOptions extends Partial<StylizeOptions> {
  /** Buffering delay of frames, so that late ones arrive in time: adapted to their jitter, or 0 to 0.2 seconds. */
  readonly delaySecs?: "auto" | number;
  /** Whether the character is pulled to the performer's position, or moves freely with its own steps. */
  readonly place?: "follow" | "free";
}

/** A performer styled as poses arrive. */
export interface Live {
  /** Receives every displayed frame, at the database's rate; not called while nothing arrives. */
  onFrame: ((frame: StreamFrame) => void) | undefined;
  /** Receives a sentence about a problem: the sender does not answer, or its data is not a body. The stream continues. */
  onTrouble: ((sentence: string) => void) | undefined;
  /** Statistics of the stream. */
  readonly stats: LiveStats;
  /** Takes effect with the next frame. @throws StrutError `bad-input`, at once */
  setStyles(styles: StyleWeights, change?: StyleChange): void;
  /** Starts a recording of the displayed frames, at most an hour. */
  record(): LiveRecorder;
  /** Closes the stream and its source. */
  close(): void;
}

/** A recording in progress. */
export interface LiveRecorder {
  /** Ends and returns the recording. */
  stop(): LiveRecording;
}

/** The recorded frames, on the body of the database and at its frame rate; 87 numbers per frame. */
export interface LiveRecording {
  /** Number of frames. */
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

/** @throws StrutError if something cannot be loaded, an option is invalid, or `cancelled` */
export async function openLive(
  engine: EngineClient,
  database: ClientDatabase,
  source: PoseSource,
  { delaySecs: delay = "auto", place = "follow", ...options }: LiveOptions = {},
  signal?: AbortSignal,
): Promise<Live> {
  if (delay !== "auto" && !(delay >= 0 && delay <= MAX_DELAY_SECS)) {
    const message = `delaySecs is ${delay}. Expected "auto", or 0 to ${MAX_DELAY_SECS} s.`;
    throw new StrutError({ code: "bad-input", message, hint: "" });
  }
  const delaySecs = delay === "auto" ? undefined : delay;
  const stream = await abortable(
    signal,
    () => LiveStream.open(engine, database, { delaySecs, follows: place === "follow", options }),
    (opening) => void opening.then((late) => late.dispose()).catch(() => {}),
  );
  return new SourceLive(stream, source);
}

const MAX_DELAY_SECS = 0.2;

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
    // The caller first sets its handler for problems.
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
        // Another engine replaces a failed one; any other refusal would be repeated.
        if (!isFault(thrown)) return;
      }
      await nextRepaint(1000 / this.#stream.database.info.rateHz);
      // With the engine, or its database, the stream ends: an open loop would keep a Node program running.
      if (this.#stream.closed) this.close();
    }
  }

  #trouble(thrown: unknown): void {
    if (!this.#closing.signal.aborted) this.onTrouble?.((thrown as Error).message);
  }
}

/** The next repaint of the browser or, without one, a delay. */
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
