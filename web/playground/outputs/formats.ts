/** The files that the page makes, for the menu. */

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

/** Sizes of a video as the menu has them, pixels; `undefined` is the picture's own. */
export const VIDEO_SIZES = {
  "as on screen": undefined,
  "1280 × 720": { width: 1280, height: 720 },
  "1920 × 1080": { width: 1920, height: 1080 },
  "1080 × 1080": { width: 1080, height: 1080 },
} as const;
export type VideoSize = keyof typeof VIDEO_SIZES;
