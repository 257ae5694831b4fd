/** One pass of the playback over the range, as recorded in a video. */
import type { LiveFrame } from "../../client/protocol";

/** What a pass needs to know of a frame. */
export type PassFrame = Pick<LiveFrame, "ended" | "looped" | "inputFrame">;

/**
 * The frames of one pass. It ends with the range, also where somebody lets the playback loop meanwhile: the frame that
 * begins anew is not part of it.
 */
export async function* onePass<T extends PassFrame>(advance: () => Promise<T>): AsyncGenerator<T> {
  for (;;) {
    const frame = await advance();
    if (frame.looped) return;
    yield frame;
    if (frame.ended) return;
  }
}
