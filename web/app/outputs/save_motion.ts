/** Saves synthesised motions of the mannequin as files. */
import { POSE_FLOATS } from "../../humanoid";
import { saveFile } from "../../ui/dom";

/** The body's proportions and its frame rate. */
interface Mover {
  readonly proportions: Float32Array;
  readonly rateHz: number;
}

/** Saves the text of a BVH file; returns the file's name. */
export function saveBvh(title: string, text: string): string {
  const name = `${title}.bvh`;
  saveFile(name, new Blob([text], { type: "text/plain" }));
  return name;
}

/** Saves the mannequin with `POSE_FLOATS` numbers per frame as a GLB file; returns the file's name. */
export async function saveGlb(title: string, { proportions, rateHz }: Mover, poses: Float32Array): Promise<string> {
  const { mannequinGlb } = await import("../../formats/mannequin_glb");
  const times = Float32Array.from({ length: poses.length / POSE_FLOATS }, (_, frame) => frame / rateHz);
  const name = `${title}.glb`;
  const bytes = mannequinGlb({ name: title, proportions, poses, times });
  saveFile(name, new Blob([bytes], { type: "model/gltf-binary" }));
  return name;
}
