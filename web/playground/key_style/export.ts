/** The keys' motion as files. */
import type { Between } from "../../worker/key_style/key_style";
import { saveFile } from "../dom";
import { strings } from "../strings/strings";
import type { Performance } from "./performance";

const { fileName } = strings.keyStyle;

/** Saves a BVH file; gives its name. */
export function saveBvh(acting: Performance, length: number, between: Between): string {
  const name = `${fileName}.bvh`;
  saveFile(name, new Blob([acting.toBvh(length, between)], { type: "text/plain" }));
  return name;
}

/** Saves the mannequin with the motion as a GLB file; gives its name. */
export async function saveGlb(acting: Performance, length: number, between: Between): Promise<string> {
  const { proportions, rateHz } = acting.model;
  const poses = acting.perform(length, between);
  const { mannequinGlb } = await import("../../viewer/mannequin_glb");
  const frames = Math.floor(length * rateHz + 1e-6) + 1;
  const times = Float32Array.from({ length: frames }, (_, frame) => frame / rateHz);
  const name = `${fileName}.glb`;
  const bytes = mannequinGlb({ name: fileName, proportions, poses, times });
  saveFile(name, new Blob([bytes], { type: "model/gltf-binary" }));
  return name;
}
