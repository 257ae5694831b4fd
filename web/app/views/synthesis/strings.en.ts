/** Shared texts of the Walk and Key-style views. */
export const synthesis = {
  exportBvh: "BVH",
  exportGlb: "GLB",
  saved: (file: string) => `Saved ${file}.`,
  zero: "0 s",
  time: "Time",
};
