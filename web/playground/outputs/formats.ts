/** The files that the page makes, for the menu. */
import type { VideoSize } from "./video";

/** A format by the ending of its files. */
export type OutputFormat = "bvh" | "glb" | "webm" | "png" | "csv" | "jsonl";

/** Formats from the top of the menu. */
export const OUTPUT_FORMATS: readonly { format: OutputFormat; name: string }[] = [
  { format: "bvh", name: "BVH" },
  { format: "glb", name: "GLB" },
  { format: "webm", name: "WebM" },
  { format: "png", name: "PNG" },
  { format: "csv", name: "CSV" },
  { format: "jsonl", name: "JSON" },
];

/** Sizes of a video, as the menu has them. */
export const VIDEO_SIZE_NAMES: readonly VideoSize[] = ["as on screen", "1280 × 720", "1920 × 1080", "1080 × 1080"];
