/** Converts models of other formats to binary glTF by three.js's exporter, for `toGLB` to append a motion. */
import type { Object3D } from "three";
import { nameInFile } from "./joints";

/** A model as binary glTF. */
interface Converted {
  readonly file: Uint8Array;
  /** Index of a node in the file. */
  readonly indexOf: (node: Object3D) => number | undefined;
}

/** The part of the exporter's writer that three.js's own plugins use; it is not in the types. */
interface Writer {
  readonly nodeMap: ReadonlyMap<Object3D, number>;
  readonly json: { readonly skins?: { skeleton?: number }[]; animations?: { channels: unknown[] }[] };
}

/**
 * Writes a model and its animations, including the object's own placement.
 * @throws Error of three.js if it cannot be written
 */
export async function converted(object: Object3D): Promise<Converted> {
  const { GLTFExporter } = await import("three/addons/exporters/GLTFExporter.js");
  let numbers: Writer["nodeMap"] = new Map();
  const exporter = new GLTFExporter().register((gltfWriter) => {
    const { nodeMap, json } = gltfWriter as unknown as Writer;
    numbers = nodeMap;
    return {
      writeNode(node, written) {
        written.name = nameInFile(node);
        delete written.extras;
      },
      afterParse() {
        // It names the first joint, which is not above the others if FBX shares joints between meshes.
        for (const skin of json.skins ?? []) delete skin.skeleton;
        // Validators reject an animation without channels.
        const moving = json.animations?.filter(({ channels }) => channels.length > 0) ?? [];
        if (moving.length > 0) json.animations = moving;
        else delete json.animations;
      },
    };
  });
  const animations = object.animations.filter(({ tracks }) => tracks.length > 0);
  const file = await exporter.parseAsync(object, { binary: true, trs: true, onlyVisible: false, animations });
  return { file: new Uint8Array(file as ArrayBuffer), indexOf: (node) => numbers.get(node) };
}
