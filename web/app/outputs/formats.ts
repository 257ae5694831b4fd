/** Formats of exported files. */

/** A format, named by its file extension. */
export type OutputFormat = "bvh" | "glb" | "vrma" | "webm" | "png" | "csv" | "jsonl";

/** Formats in the order of the menu. */
export const OUTPUT_FORMATS: readonly { format: OutputFormat; name: string }[] = [
  { format: "bvh", name: "BVH" },
  { format: "glb", name: "GLB" },
  { format: "vrma", name: "VRMA" },
  { format: "webm", name: "WebM" },
  { format: "png", name: "PNG" },
  { format: "csv", name: "CSV" },
  { format: "jsonl", name: "JSON" },
];

/** Sizes of a video in pixels, by their names in the menu; `undefined` is the size on screen. */
export const VIDEO_SIZES = {
  "as on screen": undefined,
  "1280 × 720": { width: 1280, height: 720 },
  "1920 × 1080": { width: 1920, height: 1080 },
  "1080 × 1080": { width: 1080, height: 1080 },
} as const;
export type VideoSize = keyof typeof VIDEO_SIZES;
