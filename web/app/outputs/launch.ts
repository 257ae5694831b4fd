/** Exports a file; the code for it is loaded with the first export. */

import { isCancellation } from "../../client/protocol";
import { strings } from "../strings/strings";
import type { OutputFormat, VideoSize } from "./formats";
import type { OutputSources } from "./outputs";

export async function launchOutput(format: OutputFormat, size: VideoSize, sources: OutputSources): Promise<void> {
  const { toasts } = sources;
  try {
    const { saveOutput } = await import("./outputs");
    const name = await saveOutput(format, size, sources);
    if (name) toasts.note(strings.page.outputs.saved(name));
  } catch (error) {
    if (!isCancellation(error)) toasts.failure(error);
  }
}
