/** Loading of VRMs as in pages, with three-vrm's plugin. */
import { type VRM, VRMLoaderPlugin } from "@pixiv/three-vrm";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** Loads a VRM. */
export async function loadVrm(file: ArrayBuffer): Promise<VRM> {
  const loader = new GLTFLoader();
  loader.register((parser) => new VRMLoaderPlugin(parser));
  return (await loader.parseAsync(file, "")).userData.vrm as VRM;
}
