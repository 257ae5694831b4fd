/** A joint of a BVH file. */
export interface BvhJoint {
  name: string;
  parent: number;
  offset: number[];
  channels: string[];
}
export interface BvhFile {
  joints: BvhJoint[];
  frameSecs: number;
  frames: number[][];
  header: string;
}
export function readBvh(text: string): BvhFile;
export function jsonSkeleton(bvh: BvhFile): string;
export function jsonFrame(bvh: BvhFile, channels: number[], secs: number): string;
