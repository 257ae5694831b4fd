/** Styling a whole clip, in portions that leave time for other things. */
import { Handle } from "./handle";
import type { Input } from "./input";
import type { ClipJob as RawClipJob } from "./pkg/strut_wasm.js";
import type { Stylizer } from "./stylizer";
import type { Analysis } from "./types";
import { type Glue, guarded } from "./wasm";

/** An input on its way through the engine. Unlike live playback it may look ahead for its foot contacts. */
export class ClipJob extends Handle<RawClipJob> {
  /** Frames done. */
  done = 0;
  readonly frames: number;

  /** @param stylizer gives its styles and options; it is free for other uses afterwards */
  constructor(
    glue: Glue,
    private readonly input: Input,
    stylizer: Stylizer,
  ) {
    super(
      guarded(() => new glue.ClipJob(stylizer.raw, input.raw)),
      "clip job",
    );
    this.frames = input.info.frames;
  }

  /** Styles up to `frames` more frames; true once all are done. */
  run(frames: number): boolean {
    this.done = guarded(() => this.raw.run(frames));
    return this.done >= this.frames;
  }

  /** What was styled; call it after {@link run} gave true. */
  result(): Analysis {
    return guarded(() => ({
      poses: this.raw.poses(),
      timeOut: this.raw.timeOut(),
      planted: this.raw.planted(),
      durationOutSecs: this.raw.durationSecs(),
    }));
  }

  /** The styled clip as BVH text, on the input's own skeleton and at its own rate. */
  toBvh(): string {
    return guarded(() => this.raw.toBvh(this.input.raw));
  }
}
