/** Everything that goes out of the page as a file. Loaded when the first one is asked for. */

import type { CallOptions } from "../../worker/protocol";
import { saveFile } from "../dom";
import type { Notices } from "../notices";
import type { Playhead } from "../playhead";
import type { ProgressLine } from "../progress";
import type { Session } from "../session";
import type { Stage } from "../stage";
import type { Store } from "../store";
import { strings } from "../strings/strings";
import { cancelled, exportName } from "../words";
import type { OutputFormat, VideoSize } from "./formats";
import { traceAsCsv, traceAsJson } from "./trace";

/** What the files are made of. */
export interface OutputSources {
  session: Session;
  store: Store;
  stage: Stage;
  playhead: Playhead;
  notices: Notices;
  progress: ProgressLine;
}

/** Makes a file and saves it; the name it was saved by, or `undefined` where that was cancelled or cannot be. */
export async function saveOutput(
  format: OutputFormat,
  size: VideoSize,
  sources: OutputSources,
): Promise<string | undefined> {
  const blob = await makeOutput(format, size, sources);
  if (!blob) return undefined;
  const { session, store } = sources;
  const name = exportName(session.inputName, store.state.styles, format === "jsonl" ? "jsonl" : format);
  saveFile(name, blob);
  return name;
}

async function makeOutput(format: OutputFormat, size: VideoSize, sources: OutputSources): Promise<Blob | undefined> {
  const { session, notices, stage } = sources;
  switch (format) {
    case "bvh": {
      const text = await session.exportBvh();
      return text === undefined ? undefined : new Blob([text], { type: "text/plain" });
    }
    case "glb":
      return glb(session);
    case "csv":
    case "jsonl":
      return trace(session, format);
    case "png":
      return png(await stage.picture());
    case "webm": {
      const blob = await video(size, sources);
      if (!blob) notices.error(strings.page.outputs.noVideo);
      return blob;
    }
  }
}

async function glb(session: Session): Promise<Blob | undefined> {
  const analysis = await session.styled();
  if (!analysis || !session.database) return undefined;
  const { mannequinGlb } = await import("../../viewer/mannequin_glb");
  const { poses, timeOut: times } = analysis;
  const bytes = mannequinGlb({ name: session.inputName, proportions: session.database.proportions, poses, times });
  return new Blob([bytes], { type: "model/gltf-binary" });
}

async function trace(session: Session, format: "csv" | "jsonl"): Promise<Blob | undefined> {
  const analysis = await session.styled();
  if (!analysis || !session.database || !session.input) return undefined;
  const traced = { analysis, input: session.input, classes: session.database.classes };
  return format === "csv"
    ? new Blob([traceAsCsv(traced)], { type: "text/csv" })
    : new Blob([traceAsJson(traced)], { type: "application/jsonl" });
}

function png(picture: HTMLCanvasElement): Promise<Blob | undefined> {
  return new Promise((resolve) => picture.toBlob((blob) => resolve(blob ?? undefined)));
}

/**
 * Films the range once, at the present speed, picture by picture; `undefined` where this browser cannot.
 * @throws DOMException `AbortError` where it is cancelled, or what is filmed is no longer on screen
 */
async function video(
  size: VideoSize,
  { session, store, stage, playhead, progress }: OutputSources,
): Promise<Blob | undefined> {
  const { input } = session;
  if (!input) return undefined;
  const before = store.state;
  const first = before.range?.first ?? 0;
  const last = Math.min(before.range?.last ?? input.frames - 1, input.frames - 1);
  const label = strings.page.outputs.recording;
  const { makeVideo, VIDEO_RATE } = await import("./video");
  store.edit({ playing: false, loop: false });
  playhead.goTo(first);
  await session.shown();
  const film = ({ signal, onProgress }: CallOptions) =>
    stage.film((pictureAt) => {
      async function* pictures(): AsyncGenerator<HTMLCanvasElement> {
        yield pictureAt(0);
        for (let count = 1, ended = false; !ended; count++) {
          if (session.input !== input || store.state.view !== before.view) throw cancelled();
          const frame = await session.playback.advance(before.speed / VIDEO_RATE);
          ({ ended } = frame);
          onProgress?.({ label, fraction: (frame.inputFrame - first) / Math.max(1, last - first) });
          yield pictureAt(count / VIDEO_RATE);
        }
      }
      return makeVideo(pictures(), size);
    }, signal);
  try {
    return await session.playback.hold(() => progress.run(label, film));
  } finally {
    store.edit({ loop: before.loop, playing: before.playing, frame: before.frame });
    if (!before.playing) playhead.goTo(before.frame);
  }
}
