import { strings } from "../strings/strings";

/** Longest video, seconds. The encoder keeps the whole file in memory: about 90 MB per minute. */
const MAX_VIDEO_SECS = 600;

/** Checks the length of a video before it is drawn. @throws Error with a sentence for the user, if it is too long */
export function checkVideoLength(secs: number): void {
  if (secs > MAX_VIDEO_SECS) throw new Error(strings.page.outputs.videoTooLong(secs / 60, MAX_VIDEO_SECS / 60));
}
