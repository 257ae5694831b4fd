/** Records the picture as a video, in the browser's own encoder. */
import { cancelled } from "../words";

/** Sizes on offer, pixels; `undefined` is the picture's own. */
export const VIDEO_SIZES = {
  "as on screen": undefined,
  "1280 × 720": { width: 1280, height: 720 },
  "1920 × 1080": { width: 1920, height: 1080 },
  "1080 × 1080": { width: 1080, height: 1080 },
} as const;
export type VideoSize = keyof typeof VIDEO_SIZES;

const FRAMES_PER_SEC = 60;
const BITS_PER_SEC = 12_000_000;
/** Best first. */
const TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];

/** Where the picture is, and when the recording ends. */
export interface Recording {
  /** The picture that was drawn in this frame of the browser; `undefined` where none was. */
  picture: (now: number) => HTMLCanvasElement | undefined;
  size: VideoSize;
  signal: AbortSignal;
  /** Called before every frame; what it gives, 0–1, is how much is done. At 1 the recording ends. */
  onFrame: () => number;
}

/** Whether this browser can record. */
export function canRecord(): boolean {
  return typeof MediaRecorder !== "undefined" && TYPES.some((type) => MediaRecorder.isTypeSupported(type));
}

/**
 * Records until `onFrame` says that all is done.
 * @throws DOMException `AbortError` if it is cancelled
 */
export async function recordVideo({ picture, size, signal, onFrame }: Recording): Promise<Blob> {
  const { width, height } = VIDEO_SIZES[size] ?? (await sizeOf(picture));
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [width, height];
  const context = copy.getContext("2d", { alpha: false })!;
  const stream = copy.captureStream(FRAMES_PER_SEC);
  const type = TYPES.find((name) => MediaRecorder.isTypeSupported(name))!;
  const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: BITS_PER_SEC });
  const parts: Blob[] = [];
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  const stopped = new Promise((resolve) => recorder.addEventListener("stop", resolve, { once: true }));
  recorder.start();
  try {
    await frames((now) => {
      if (signal.aborted) throw cancelled();
      const drawn = picture(now);
      if (drawn) drawCovering(context, drawn, width, height);
      return onFrame() >= 1;
    });
  } finally {
    recorder.stop();
    for (const track of stream.getTracks()) track.stop();
    await stopped;
  }
  return new Blob(parts, { type: "video/webm" });
}

/** Encoders want even sizes. */
const even = (n: number): number => Math.max(2, n - (n % 2));

/** Size of the next picture that is drawn. */
async function sizeOf(picture: Recording["picture"]): Promise<{ width: number; height: number }> {
  let drawn: HTMLCanvasElement | undefined;
  await frames((now) => {
    drawn = picture(now);
    return drawn !== undefined;
  });
  return { width: even(drawn!.width), height: even(drawn!.height) };
}

/** Calls `draw` every repaint until it gives true. */
function frames(draw: (now: number) => boolean): Promise<void> {
  return new Promise((resolve, reject) => {
    const tick = (now: number) => {
      try {
        if (draw(now)) resolve();
        else requestAnimationFrame(tick);
      } catch (error) {
        reject(error as Error);
      }
    };
    requestAnimationFrame(tick);
  });
}

/** Draws the middle of a picture so that it fills another size. */
function drawCovering(
  context: CanvasRenderingContext2D,
  source: HTMLCanvasElement,
  width: number,
  height: number,
): void {
  const scale = Math.max(width / source.width, height / source.height);
  const [w, h] = [source.width * scale, source.height * scale];
  context.imageSmoothingQuality = "high";
  context.drawImage(source, (width - w) / 2, (height - h) / 2, w, h);
}
