/** Exported files. Loaded with the first export. */

import type { StyledPoses } from "../../character/types";
import { bvhBytes } from "../../client/bvh_bytes";
import type { CallOptions } from "../../client/protocol";
import { traceAsCsv, traceAsJson } from "../../formats/trace";
import type { Session } from "../../player/session";
import { saveFile } from "../../ui/dom";
import type { Playhead } from "../state/playhead";
import type { Store } from "../state/store";
import { strings } from "../strings/strings";
import type { Film, PictureSize } from "../ui/film";
import type { ProgressLine } from "../ui/progress";
import type { Toasts } from "../ui/toasts";
import { cancelled, exportName } from "../ui/words";
import { type OutputFormat, VIDEO_SIZES, type VideoContainer, type VideoSize } from "./formats";
import { onePass } from "./one_pass";
import { pngOf } from "./png";
import { checkVideoLength } from "./video_length";

/** Media type of GLB files. */
const GLB = "model/gltf-binary";

/** Renders the viewer's picture independently of the clock. */
export interface Pictures {
  /** A copy of the picture, optionally at a size other than the displayed one. */
  picture(size?: PictureSize): Promise<HTMLCanvasElement>;
  readonly film: Film;
}

/** Sources of exported files. */
export interface OutputSources {
  session: Session;
  store: Store;
  pictures: Pictures;
  /**
   * The file of the character in use, with a motion; `undefined` for the mannequin.
   * @throws StrutError `licence` if its author forbids that
   */
  characterGlb: (motion: StyledPoses) => Uint8Array<ArrayBuffer> | undefined;
  playhead: Playhead;
  toasts: Toasts;
  progress: ProgressLine;
}

/** Makes and saves a file. Returns its name, or `undefined` if it was cancelled or failed. */
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
  const { session, toasts, pictures } = sources;
  switch (format) {
    case "bvh": {
      const text = await session.exportBvh();
      return text === undefined ? undefined : new Blob([bvhBytes(text)], { type: "text/plain" });
    }
    case "glb":
      return glb(sources);
    case "vrma":
      return vrma(session);
    case "csv":
    case "jsonl":
      return trace(session, format);
    case "png":
      return pngOf(await pictures.picture(VIDEO_SIZES[size]));
    case "webm":
    case "mp4": {
      const blob = await video(size, format, sources);
      if (!blob) toasts.error(strings.page.outputs.noVideo);
      return blob;
    }
  }
}

async function glb({ session, characterGlb, toasts }: OutputSources): Promise<Blob | undefined> {
  const analysis = await session.styled();
  if (!analysis || !session.database) return undefined;
  const { inputName: name } = session;
  const { proportions } = session.database;
  const { poses, timeOut } = analysis;
  try {
    const own = characterGlb({ name, proportions, poses, timeOut });
    if (own) return new Blob([own], { type: GLB });
  } catch (error) {
    if ((error as { code?: unknown }).code !== "licence") throw error;
    toasts.error(strings.page.characters.noExport);
    return undefined;
  }
  const { mannequinGlb } = await import("../../formats/mannequin_glb");
  return new Blob([mannequinGlb({ name, proportions, poses, times: timeOut })], { type: GLB });
}

async function vrma(session: Session): Promise<Blob | undefined> {
  const analysis = await session.styled();
  if (!analysis || !session.database) return undefined;
  const { vrmAnimation } = await import("../../formats/vrma");
  const { poses, timeOut: times } = analysis;
  const { proportions } = session.database;
  return new Blob([vrmAnimation({ name: session.inputName, proportions, poses, times })], { type: GLB });
}

async function trace(session: Session, format: "csv" | "jsonl"): Promise<Blob | undefined> {
  const analysis = await session.styled();
  if (!analysis || !session.database || !session.input) return undefined;
  const traced = { analysis, input: session.input, classes: session.database.classes };
  return format === "csv"
    ? new Blob([traceAsCsv(traced)], { type: "text/csv" })
    : new Blob([traceAsJson(traced)], { type: "application/jsonl" });
}

/**
 * Records the range once at the current speed, frame by frame; `undefined` if the browser has no encoder.
 * @throws DOMException `AbortError` if it is cancelled, or another input or view is shown
 */
async function video(
  size: VideoSize,
  container: VideoContainer,
  { session, store, pictures, playhead, progress }: OutputSources,
): Promise<Blob | undefined> {
  const { input, database } = session;
  if (!input || !database) return undefined;
  const before = store.state;
  const first = before.range?.first ?? 0;
  const last = Math.min(before.range?.last ?? input.frames - 1, input.frames - 1);
  checkVideoLength((last - first) / database.rateHz / before.speed);
  const label = strings.page.outputs.recording;
  const { makeVideo, VIDEO_RATE } = await import("./video");
  store.edit({ playing: false, loop: false });
  playhead.goTo(first);
  await session.shown();
  const advance = () => {
    if (session.input !== input || store.state.view !== before.view) throw cancelled();
    return session.playback.advance(before.speed / VIDEO_RATE);
  };
  const film = ({ signal, onProgress }: CallOptions) =>
    pictures.film(
      (pictureAt) => {
        async function* frames(): AsyncGenerator<HTMLCanvasElement> {
          yield pictureAt(0);
          let count = 0;
          for await (const { inputFrame } of onePass(advance)) {
            onProgress?.({ label, fraction: (inputFrame - first) / Math.max(1, last - first) });
            yield pictureAt(++count / VIDEO_RATE);
          }
        }
        return makeVideo(frames(), size, [container]);
      },
      { signal, size: VIDEO_SIZES[size] },
    );
  try {
    return (await session.playback.hold(() => progress.run(label, film)))?.blob;
  } finally {
    store.edit({ loop: before.loop, playing: before.playing, frame: before.frame });
    if (!before.playing) playhead.goTo(before.frame);
  }
}
