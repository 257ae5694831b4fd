/** One pass of the playback over the range, for a video. */
import type { LiveFrame } from "../../client/protocol";

/** The properties of a frame that a pass needs. */
export type PassFrame = Pick<LiveFrame, "ended" | "looped" | "inputFrame">;

/**
 * The frames of one pass. It ends with the range, even if the user turns looping on meanwhile: the frame that restarts
 * is not part of it.
 */
export async function* onePass<T extends PassFrame>(advance: () => Promise<T>): AsyncGenerator<T> {
  for (;;) {
    const frame = await advance();
    if (frame.looped) return;
    yield frame;
    if (frame.ended) return;
  }
}
