/** Encodes a video with the browser's encoder, at a constant frame rate, however long a frame takes to draw. */
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
import { VIDEO_SIZES, type VideoContainer, type VideoSize } from "./formats";

/** Frames per second. */
export const VIDEO_RATE = 60;
const QUALITY = new Quality({ bitrate: 12_000_000 });
/** Codecs of each container in the order of preference. */
const CODECS: Record<VideoContainer, VideoCodec[]> = { webm: ["vp9", "vp8", "av1"], mp4: ["avc"] };

interface Video {
  readonly container: VideoContainer;
  readonly blob: Blob;
}

/** A video that is being encoded. */
interface Encoder {
  readonly container: VideoContainer;
  readonly output: Output<Mp4OutputFormat | WebMOutputFormat, BufferTarget>;
  readonly source: CanvasSource;
}

/**
 * Makes a video at {@link VIDEO_RATE} frames per second, in the first container for which this browser encodes pictures of this
 * size; `undefined` if there is none.
 * @throws whatever `pictures` throws, after the encoder is freed
 */
export async function makeVideo(
  pictures: AsyncIterable<HTMLCanvasElement>,
  size: VideoSize,
  containers: readonly VideoContainer[],
): Promise<Video | undefined> {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d", { alpha: false })!;
  let encoder: Encoder | undefined;
  let count = 0;
  try {
    for await (const picture of pictures) {
      if (!encoder) {
        Object.assign(canvas, VIDEO_SIZES[size] ?? { width: even(picture.width), height: even(picture.height) });
        encoder = await startEncoder(canvas, containers);
        if (!encoder) return undefined;
      }
      drawCovering(context, picture, canvas.width, canvas.height);
      await encoder.source.add(count / VIDEO_RATE, 1 / VIDEO_RATE);
      count += 1;
    }
    if (!encoder) return undefined;
    const { container, output } = encoder;
    await output.finalize();
    return { container, blob: new Blob([output.target.buffer!], { type: output.format.mimeType }) };
  } finally {
    if (encoder && encoder.output.state !== "finalized") await encoder.output.cancel();
  }
}

/** Starts an encoder for a canvas, in the first container that this browser can write. */
async function startEncoder(
  canvas: HTMLCanvasElement,
  containers: readonly VideoContainer[],
): Promise<Encoder | undefined> {
  const { width, height } = canvas;
  for (const container of containers) {
    const codec = await getFirstEncodableVideoCodec(CODECS[container], { width, height, quality: QUALITY });
    if (!codec) continue;
    const format = container === "mp4" ? new Mp4OutputFormat({ fastStart: "in-memory" }) : new WebMOutputFormat();
    const output = new Output({ format, target: new BufferTarget() });
    const source = new CanvasSource(canvas, { codec, quality: QUALITY });
    output.addVideoTrack(source, { frameRate: VIDEO_RATE });
    await output.start();
    return { container, output, source };
  }
  return undefined;
}

/**
 * Makes an MP4 video, or WebM if this browser cannot encode MP4 at this size, and saves it. Returns its name, or
 * `undefined` if this browser has no encoder.
 * @throws whatever `pictures` throws
 */
export async function saveVideo(
  title: string,
  pictures: AsyncIterable<HTMLCanvasElement>,
  size: VideoSize,
): Promise<string | undefined> {
  const video = await makeVideo(pictures, size, ["mp4", "webm"]);
  if (!video) return undefined;
  const name = `${title}.${video.container}`;
  saveFile(name, video.blob);
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
