/** The call that records a motion in every style of a database, for crowds that perform it. */
import { StrutError } from "../../engine/errors";
import { Recording, recordedPart } from "../../engine/recording";
import type { FrameRange, RecordedMotion, StylizeOptions } from "../protocol";
import type { Caller } from "../rpc_server";
import { OpenDatabase } from "./databases";
import type { Host } from "./host";
import { carriedMotion } from "./motions";
import { runToEnd } from "./time_slices";

export async function recordMotion(
  host: Host,
  caller: Caller,
  motion: number,
  database: number,
  options: StylizeOptions,
  range: FrameRange | undefined,
): Promise<RecordedMotion> {
  const carried = await carriedMotion(host, caller, motion, database);
  const { input } = carried;
  const opened = host.open.get(OpenDatabase, database).database;
  const { styles, rateHz } = opened.info;
  const { first, frames } = recordedPart({ frames: input.info.frames, rateHz }, styles.length, range);
  if (frames < 1) throw new StrutError({ code: "bad-input", message: "The range is outside the motion.", hint: "" });
  const stylizer = host.engine.createStylizer(opened, options);
  let recording: Recording | undefined;
  try {
    recording = new Recording(input, stylizer, first, frames);
    const isCancelled = () => caller.isCancelled() || !host.open.has(carried);
    await runToEnd(recording, { ...caller, isCancelled });
    return { styles: [...styles], numbers: recording.numbers(), secs: frames / rateHz };
  } finally {
    recording?.dispose();
    stylizer.dispose();
  }
}
