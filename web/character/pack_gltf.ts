/** Packs a `.gltf` with its files into one binary glTF, which the other modules read, check and write. */
import { StrutError } from "../engine/errors";
import { glbOf, paddedLength } from "./glb_patch";
import { isRecord } from "./vrm_humanoid";

/** A file by its path. */
interface FileBeside {
  readonly path: string;
  bytes(): Promise<Uint8Array>;
}

/** Maximum number of bytes of all files together. */
const MAX_BYTES = 128 * 1024 * 1024;

/**
 * Packs several files into one. Data inside the document stays there.
 * @param document the bytes of the `.gltf` at `path`
 * @param beside returns a file that the document names; `undefined` if it is missing
 * @throws StrutError `bad-file` if the document is invalid, or names files that are missing
 */
export async function packedGltf(
  document: Uint8Array,
  beside: (uri: string) => Promise<Uint8Array | undefined>,
): Promise<Uint8Array<ArrayBuffer>> {
  const json = parsed(document);
  const missing: string[] = [];
  const parts: Uint8Array[] = [];
  let length = 0;
  const add = (bytes: Uint8Array): number => {
    const start = length;
    parts.push(bytes);
    length += paddedLength(bytes.length);
    if (length > MAX_BYTES)
      throw new StrutError({
        code: "bad-file",
        message: "This model has more than 128 MB.",
        hint: "Make its textures smaller.",
      });
    return start;
  };
  const take = async (uri: unknown): Promise<Uint8Array | undefined> => {
    if (typeof uri !== "string") return undefined;
    const data = dataOf(uri);
    if (data) return data;
    const found = await beside(decoded(uri));
    if (!found) missing.push(decoded(uri));
    return found;
  };

  // All buffers are joined into one; each has its offset in it.
  const starts: number[] = [];
  for (const buffer of records(json.buffers)) starts.push(add((await take(buffer.uri)) ?? new Uint8Array()));
  const bufferViews: Record<string, unknown>[] = records(json.bufferViews).map((view) => ({
    ...view,
    buffer: 0,
    byteOffset: Number(view.byteOffset ?? 0) + (starts[Number(view.buffer)] ?? 0),
  }));
  const images: Record<string, unknown>[] = [];
  for (const image of records(json.images)) {
    const { uri, ...rest } = image;
    const bytes = typeof uri === "string" ? await take(uri) : undefined;
    if (!bytes) {
      images.push(typeof uri === "string" ? rest : image);
      continue;
    }
    const bufferView = bufferViews.push({ buffer: 0, byteOffset: add(bytes), byteLength: bytes.length }) - 1;
    images.push({ ...rest, bufferView, mimeType: rest.mimeType ?? typeOf(bytes) });
  }
  const lost = missing.filter((name) => !/\.(png|jpe?g|webp|avif|ktx2)$/i.test(name));
  if (lost.length > 0)
    throw new StrutError({
      code: "bad-file",
      message: `This model keeps a part of itself in another file: ${lost.join(", ")}.`,
      hint: "Drop the files together, or their folder, or a zip of it; or export one .glb file.",
    });
  return glbOf(
    { ...json, buffers: length > 0 ? [{ byteLength: length }] : [], bufferViews, images: images.map(withSource) },
    parts,
  );
}

/** A missing image has no source: three.js leaves it out, and a note says so. */
function withSource(image: Record<string, unknown>): Record<string, unknown> {
  return image.bufferView === undefined && image.uri === undefined ? { ...image, uri: "data:," } : image;
}

/** The files of a `.gltf` among others, by the path in the document, relative to its own folder. */
export function packedWith(document: FileBeside, files: readonly FileBeside[]): Promise<Uint8Array<ArrayBuffer>> {
  const folder = document.path.replace(/[^/]*$/, "");
  const beside = async (uri: string) => {
    const path = `${folder}${uri.replace(/^\.\//, "")}`;
    const name = uri.replace(/^.*\//, "");
    // Files that are dropped together come without their folders.
    const found =
      files.find((file) => file.path === path) ?? files.find((file) => file.path.replace(/^.*\//, "") === name);
    return found?.bytes();
  };
  return document.bytes().then((bytes) => packedGltf(bytes, beside));
}

function parsed(document: Uint8Array): Record<string, unknown> {
  try {
    const json: unknown = JSON.parse(new TextDecoder().decode(document));
    if (isRecord(json) && isRecord(json.asset)) return json;
  } catch {
    // The same message as for an invalid document.
  }
  throw new StrutError({
    code: "bad-file",
    message: "The glTF document in this file is damaged.",
    hint: "Export the model again as .glb.",
  });
}

/** The bytes of a `data:` URL; `undefined` for other URLs. */
function dataOf(uri: string): Uint8Array | undefined {
  const [, base64, text] = /^data:[^,]*?(;base64)?,(.*)$/s.exec(uri) ?? [];
  if (text === undefined) return undefined;
  try {
    return base64
      ? Uint8Array.from(atob(text), (c) => c.charCodeAt(0))
      : new TextEncoder().encode(decodeURIComponent(text));
  } catch {
    return new Uint8Array();
  }
}

function decoded(uri: string): string {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
}

const typeOf = (bytes: Uint8Array): string => (bytes[0] === 0x89 ? "image/png" : "image/jpeg");

const records = (list: unknown): Record<string, unknown>[] => (Array.isArray(list) ? list.filter(isRecord) : []);
