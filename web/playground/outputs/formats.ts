/** The files that the page makes, for the menu. */
import type { VideoSize } from "./video";

/** A format by the ending of its files. */
export type OutputFormat = "bvh" | "glb" | "webm" | "png" | "csv" | "jsonl";

/** Formats from the top of the menu. */
export const OUTPUT_FORMATS: readonly { format: OutputFormat; name: string; what: string }[] = [
  { format: "bvh", name: "BVH", what: "the motion on the input's own skeleton" },
  { format: "glb", name: "GLB", what: "the mannequin with the animation" },
  { format: "webm", name: "WebM", what: "a video of what you see" },
  { format: "png", name: "PNG", what: "this picture" },
  { format: "csv", name: "CSV", what: "times, contacts and class weights, a row a frame" },
  { format: "jsonl", name: "JSON", what: "the same, a line a frame" },
];

/** Sizes of a video, as the menu has them. */
export const VIDEO_SIZE_NAMES: readonly VideoSize[] = ["as on screen", "1280 × 720", "1920 × 1080", "1080 × 1080"];
