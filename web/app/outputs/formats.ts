/** Formats of exported files. */

/** A format, named by its file extension. */
export type OutputFormat = "bvh" | "glb" | "vrma" | "webm" | "mp4" | "png" | "csv" | "jsonl";

/** Formats in the order of the menu. */
export const OUTPUT_FORMATS: readonly { format: OutputFormat; name: string }[] = [
  { format: "bvh", name: "BVH" },
  { format: "glb", name: "GLB" },
  { format: "vrma", name: "VRMA" },
  { format: "webm", name: "WebM" },
  { format: "mp4", name: "MP4" },
  { format: "png", name: "PNG" },
  { format: "csv", name: "CSV" },
  { format: "jsonl", name: "JSON" },
];

/** Containers of videos, by their file extensions. */
export type VideoContainer = Extract<OutputFormat, "webm" | "mp4">;

/** H.264, profile High, level 4: the usual codec of an MP4 file, up to 1920 × 1080 pixels. */
const H264 = "avc1.640028";

/** Whether this browser can encode MP4 videos. Builds of Chromium without licensed codecs cannot. */
export async function makesMp4(): Promise<boolean> {
  if (typeof VideoEncoder === "undefined") return false;
  const config = { codec: H264, width: 1920, height: 1080 };
  const { supported } = await VideoEncoder.isConfigSupported(config).catch(() => ({ supported: false }));
  return supported === true;
}

/** Sizes of a video in pixels, by their names in the menu; `undefined` is the displayed size. */
export const VIDEO_SIZES = {
  "as on screen": undefined,
  "1280 × 720": { width: 1280, height: 720 },
  "1920 × 1080": { width: 1920, height: 1080 },
  "1080 × 1080": { width: 1080, height: 1080 },
} as const;
export type VideoSize = keyof typeof VIDEO_SIZES;
