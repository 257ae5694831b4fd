/** Everything that goes out of the page as a file. Loaded when the first one is asked for. */
import { saveFile } from "../dom";
import type { Notices } from "../notices";
import type { Playhead } from "../playhead";
import type { ProgressLine } from "../progress";
import type { Session } from "../session";
import type { Stage } from "../stage";
import type { Store } from "../store";
import { strings } from "../strings/strings";
import { exportName } from "../words";
import type { OutputFormat } from "./formats";
import { traceAsCsv, traceAsJson } from "./trace";
import { canRecord, recordVideo, type VideoSize } from "./video";

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
      return stage.unmarked(async () => {
        const picture = await stage.nextPicture();
        return new Promise((resolve) => picture.toBlob((blob) => resolve(blob ?? undefined)));
      });
    case "webm":
      if (canRecord()) return stage.unmarked(() => video(size, sources));
      notices.error(strings.page.outputs.noVideo);
      return undefined;
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

/** Plays the range once, at the present speed, and records it. */
async function video(
  size: VideoSize,
  { session, store, stage, playhead, progress }: OutputSources,
): Promise<Blob | undefined> {
  const { input } = session;
  if (!input) return undefined;
  const before = store.state;
  const first = before.range?.first ?? 0;
  const last = Math.min(before.range?.last ?? input.frames - 1, input.frames - 1);
  const controller = new AbortController();
  store.edit({ playing: false, loop: false });
  playhead.goTo(first);
  await session.shown();
  store.edit({ playing: true });
  let blob: Blob | undefined;
  try {
    blob = await progress.run(strings.page.outputs.recording, ({ signal, onProgress }) => {
      signal?.addEventListener("abort", () => controller.abort());
      return recordVideo({
        picture: (now) => stage.pictureOf(now),
        size,
        signal: controller.signal,
        onFrame: () => {
          stage.invalidate();
          const at = playhead.frame?.inputFrame ?? first;
          const fraction = Math.min(1, (at - first) / Math.max(1, last - first));
          onProgress?.({ label: strings.page.outputs.recording, fraction });
          return playhead.frame?.ended || !store.state.playing ? 1 : Math.min(fraction, 0.999);
        },
      });
    });
  } finally {
    store.edit({ loop: before.loop, playing: before.playing, frame: before.frame });
    if (!before.playing) playhead.goTo(before.frame);
  }
  return blob;
}
