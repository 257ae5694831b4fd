/** Records a motion's prediction in every style of a database, for crowds that perform it. Uses the engine's own package. */
import { Handle } from "./handle";
import type { Input } from "./input";
import * as glue from "./pkg/strut_wasm.js";
import type { Stylizer } from "./stylizer";
import { guarded } from "./wasm";

/** Longest part of a motion that is recorded, seconds, and the maximum memory of a recording, bytes. */
const LONGEST_SECS = 30;
const MOST_BYTES = 32e6;
/** Bytes per frame and style. */
const STYLE_BYTES = 284;

/** The part of an input that is recorded: the range, cut to the memory limit. */
export function recordedPart(
  { frames, rateHz }: Pick<Input["info"], "frames" | "rateHz">,
  styles: number,
  range: { first: number; last: number } | undefined,
): { first: number; frames: number } {
  const first = Math.min(range?.first ?? 0, frames);
  const end = Math.min(frames, (range?.last ?? frames) + 1);
  const room = Math.floor(Math.min(LONGEST_SECS * rateHz, MOST_BYTES / (STYLE_BYTES * styles)));
  return { first, frames: Math.max(0, Math.min(end - first, room)) };
}

/** The recording of a part of an input. */
export class Recording extends Handle<glue.Recording> {
  /** Number of frames done. */
  done = 0;

  /** @param stylizer source of the options; it is free for other uses afterwards */
  constructor(
    input: Input,
    stylizer: Stylizer,
    first: number,
    readonly frames: number,
  ) {
    super(
      guarded(() => new glue.Recording(stylizer.raw as glue.Stylizer, input.raw as glue.Input, first, frames)),
      "recording",
    );
  }

  /** Predicts up to `frames` more frames. Returns true once all are done. */
  run(frames: number): boolean {
    this.done = guarded(() => this.raw.run(frames));
    return this.done >= this.frames;
  }

  /** The prediction, for `performers/`. Call it after {@link run} returned true. @throws StrutError if it is too short */
  numbers(): Float32Array<ArrayBuffer> {
    return guarded(() => this.raw.numbers()) as Float32Array<ArrayBuffer>;
  }
}
