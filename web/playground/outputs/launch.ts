/** Makes and saves a file that was asked for, one at a time; what makes them is loaded with the first. */

import { strings } from "../strings/strings";
import { errorText, isCancellation } from "../words";
import type { OutputFormat, VideoSize } from "./formats";
import type { OutputSources } from "./outputs";

export async function launchOutput(format: OutputFormat, size: VideoSize, sources: OutputSources): Promise<void> {
  const { notices } = sources;
  try {
    const { saveOutput } = await import("./outputs");
    const name = await saveOutput(format, size, sources);
    if (name) notices.note(strings.page.outputs.saved(name));
  } catch (error) {
    if (!isCancellation(error)) notices.error(errorText(error));
  }
}
