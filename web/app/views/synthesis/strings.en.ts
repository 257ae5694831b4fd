/** What the Walk and Key-style views both say. */
export const synthesis = {
  exportBvh: "BVH",
  exportGlb: "GLB",
  saved: (file: string) => `Saved ${file}.`,
  zero: "0 s",
  time: "Time",
};
