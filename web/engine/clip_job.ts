/** Styling of a whole clip in steps, between which other work can run. */
import { notesIn } from "./file_read";
import { Handle } from "./handle";
import type { Input } from "./input";
import type { ClipJob as RawClipJob } from "./pkg/strut_wasm.js";
import { type WeightKey, weightsAt } from "./style_track";
import type { Stylizer } from "./stylizer";
import type { Analysis, CurveSubject, Examples, StyleKey } from "./types";
import { type Glue, guarded } from "./wasm";

/** The styling of one input. Unlike live playback it may look ahead for foot contacts. */
export class ClipJob extends Handle<RawClipJob> {
  /** Number of frames done. */
  done = 0;
  readonly frames: number;
  readonly #track: WeightKey[];

  /**
   * @param stylizer source of the styles and options; it is free for other uses afterwards
   * @param track styles over time; without keys, the stylizer's styles
   */
  constructor(
    glue: Glue,
    private readonly input: Input,
    stylizer: Stylizer,
    track: readonly StyleKey[] = [],
  ) {
    super(
      guarded(() => new glue.ClipJob(stylizer.raw, input.raw)),
      "clip job",
    );
    this.frames = input.info.frames;
    this.#track = track.map(({ frame, styles }) => ({ frame, weights: stylizer.weightsOf(styles) }));
  }

  /** Styles up to `frames` more frames. Returns true once all are done. */
  run(frames: number): boolean {
    this.done = guarded(() => (this.#track.length > 0 ? this.#runTrack(frames) : this.raw.run(frames)));
    return this.done >= this.frames;
  }

  #runTrack(frames: number): number {
    const weights = this.#track[0]!.weights.slice();
    const end = Math.min(this.done + frames, this.frames);
    let { done } = this;
    while (done < end) {
      weightsAt(this.#track, done, weights);
      this.raw.setStyles(weights);
      done = this.raw.run(1);
    }
    return done;
  }

  /** The styled clip; call it after {@link run} returned true. */
  result(): Analysis {
    // The module of the first seconds opens no files; it computes neither notes nor distances.
    const isFile = this.input.info.source === "bvh";
    return guarded(() => ({
      poses: this.raw.poses(),
      timeOut: this.raw.timeOut(),
      planted: this.raw.planted(),
      classWeights: this.raw.classWeights(),
      durationOutSecs: this.raw.durationSecs(),
      notes: isFile ? notesIn(this.raw.notes()) : [],
      distanceMetres: isFile ? this.raw.distanceMetres() : undefined,
    }));
  }

  /** The examples behind each frame, with the values that a curve shows. */
  examples(subject: CurveSubject): Examples {
    return guarded(() => ({
      subject,
      counts: this.raw.exampleCounts(),
      weights: this.raw.exampleWeights(),
      values: subject === "height" ? this.raw.exampleHeights() : this.raw.exampleRotations(subject),
    }));
  }

  /** The styled clip as BVH text, on the input's own skeleton and at its own frame rate. */
  toBvh(): string {
    return guarded(() => this.raw.toBvh(this.input.raw));
  }
}
