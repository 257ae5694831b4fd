/** Characters in archives: a zip that contains a model and no clips. */
import type { DroppedFile } from "../../client/build/protocol";
import { Archive, readDirectory, readEntry } from "../../client/build/zip";

/** Maximum number of bytes of a file in it. */
const MAX_BYTES = 128 * 1024 * 1024;
/** Maximum number of files of an archive that is examined. */
const MAX_FILES = 1000;

/** The model of an archive and all files in it; `undefined` if it contains no model, or also clips. */
export async function modelIn(archive: File): Promise<{ model: File; beside: DroppedFile[] } | undefined> {
  try {
    const zip = new Archive(archive);
    const entries = (await readDirectory(zip)).filter(({ name }) => !/(^|\/)(__MACOSX\/|\.)/.test(name));
    const models = entries.filter(({ name }) => /\.(gltf|glb|vrm|fbx)$/i.test(name));
    if (models.length !== 1 || entries.length > MAX_FILES || entries.some(({ name }) => /\.bvh$/i.test(name)))
      return undefined;
    const beside: DroppedFile[] = [];
    for (const entry of entries) {
      const name = entry.name.replace(/^.*\//, "");
      beside.push({ path: entry.name, file: new File([await readEntry(zip, entry, MAX_BYTES)], name) });
    }
    return { model: beside[entries.indexOf(models[0]!)]!.file, beside };
  } catch {
    // The reader of clip archives reports what is wrong with it.
    return undefined;
  }
}
