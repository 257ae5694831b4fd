/** Encodes a video with the browser's encoder, at a constant frame rate whatever the time to draw a frame. */
import {
  BufferTarget,
  CanvasSource,
  getFirstEncodableVideoCodec,
  Mp4OutputFormat,
  Output,
  Quality,
  type VideoCodec,
  WebMOutputFormat,
} from "mediabunny";
import { saveFile } from "../../ui/dom";
import { commonContainer, VIDEO_SIZES, type VideoContainer, type VideoSize } from "./formats";

/** Frames per second. */
export const VIDEO_RATE = 60;
const QUALITY = new Quality({ bitrate: 12_000_000 });
/** Codecs of each container in the order of preference. */
const CODECS: Record<VideoContainer, VideoCodec[]> = { webm: ["vp9", "vp8", "av1"], mp4: ["avc"] };

/**
 * Makes a video at {@link VIDEO_RATE} frames per second; `undefined` where this browser has no encoder for it.
 * @throws whatever `pictures` throws, after the encoder is freed
 */
export async function makeVideo(
  pictures: AsyncIterable<HTMLCanvasElement>,
  size: VideoSize,
  container: VideoContainer,
): Promise<Blob | undefined> {
  const format = container === "mp4" ? new Mp4OutputFormat({ fastStart: "in-memory" }) : new WebMOutputFormat();
  const output = new Output({ format, target: new BufferTarget() });
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d", { alpha: false })!;
  let source: CanvasSource | undefined;
  let count = 0;
  try {
    for await (const picture of pictures) {
      if (!source) {
        Object.assign(canvas, VIDEO_SIZES[size] ?? { width: even(picture.width), height: even(picture.height) });
        const { width, height } = canvas;
        const codec = await getFirstEncodableVideoCodec(CODECS[container], { width, height, quality: QUALITY });
        if (!codec) return undefined;
        source = new CanvasSource(canvas, { codec, quality: QUALITY });
        output.addVideoTrack(source, { frameRate: VIDEO_RATE });
        await output.start();
      }
      drawCovering(context, picture, canvas.width, canvas.height);
      await source.add(count / VIDEO_RATE, 1 / VIDEO_RATE);
      count += 1;
    }
    await output.finalize();
  } finally {
    if (output.state !== "finalized") await output.cancel();
  }
  return new Blob([output.target.buffer!], { type: format.mimeType });
}

/**
 * Makes a video in the container that most programs open, and saves it; its name, or `undefined` where this browser has no
 * encoder.
 * @throws whatever `pictures` throws
 */
export async function saveVideo(
  title: string,
  pictures: AsyncIterable<HTMLCanvasElement>,
  size: VideoSize,
): Promise<string | undefined> {
  const container = await commonContainer();
  const blob = await makeVideo(pictures, size, container);
  if (!blob) return undefined;
  const name = `${title}.${container}`;
  saveFile(name, blob);
  return name;
}

/** Encoders need even sizes. */
const even = (n: number): number => Math.max(2, n - (n % 2));

/** Draws a picture centred and cropped to fill another size. */
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
