/**
 * Decompresses the Draco meshes of a glTF document to plain arrays. three.js's loader would decode them in a worker
 * from a blob, which the policies of some pages forbid; it reads the result as any other file.
 */
import { DracoDecoder, type DracoMesh } from "../engine/character/draco";
import { StrutError } from "../engine/errors";
import { type GlbChunks, glbOf, paddedLength } from "./glb_patch";
import { COMPONENTS, DRACO, MAX_NUMBERS, primitivesOf, records } from "./gltf_check";
import { isRecord } from "./vrm_humanoid";

type Json = Record<string, unknown>;

/** glTF's constants for 32-bit whole numbers, and for lists of triangles. */
const [UINT32, TRIANGLES] = [5125, 4];

/**
 * The file without Draco.
 * @param chunks chunks that {@link checkGltf} has accepted
 * @throws StrutError `bad-file` if a mesh cannot be decoded or all together are too long, `load` if the decoder cannot
 * be loaded
 */
export async function withoutDraco({ json, binary }: GlbChunks): Promise<Uint8Array<ArrayBuffer>> {
  const document = structuredClone(json);
  const meshes = new Meshes(document, binary);
  const isRequired = listed(json.extensionsRequired).includes(DRACO);
  let decoder: DracoDecoder | undefined;
  for (const primitive of primitivesOf(document)) {
    const extensions = primitive.extensions as Json;
    if (!isRecord(extensions) || !(DRACO in extensions)) continue;
    // Files for programs without Draco contain the plain arrays as well.
    if (isRequired || !meshes.arePlain(primitive)) {
      decoder ??= await DracoDecoder.load();
      meshes.decode(primitive, extensions[DRACO], decoder);
    }
    delete extensions[DRACO];
  }
  for (const key of ["extensionsUsed", "extensionsRequired"])
    if (key in document) document[key] = listed(document[key]).filter((name) => name !== DRACO);
  return meshes.file();
}

/** A document whose meshes are decoded one by one, and the data added to its buffer. */
class Meshes {
  readonly #views: Json[];
  readonly #accessors: Json[];
  readonly #parts: Uint8Array[];
  /** Primitives with the same arrays are decoded once. */
  readonly #decoded = new Map<string, Json>();
  #length: number;
  #numbers = 0;

  constructor(
    private readonly document: Json,
    private readonly binary: Uint8Array,
  ) {
    this.#views = records(document, "bufferViews");
    this.#accessors = records(document, "accessors");
    this.#parts = [binary];
    this.#length = paddedLength(binary.length);
  }

  /** Whether the file also contains all arrays of a primitive uncompressed. */
  arePlain({ attributes, indices }: Json): boolean {
    const all = [indices, ...Object.values(isRecord(attributes) ? attributes : {})];
    return all.every((accessor) => this.#accessors[Number(accessor)]?.bufferView !== undefined);
  }

  /** Replaces a primitive's arrays by plain ones. */
  decode(primitive: Json, packed: unknown, decoder: DracoDecoder): void {
    const { attributes, indices, mode = TRIANGLES } = primitive;
    if (!isRecord(packed) || !isRecord(packed.attributes) || !isRecord(attributes)) throw damaged();
    if (mode !== TRIANGLES)
      throw new StrutError({
        code: "bad-file",
        message: "A compressed mesh of this model is not a list of triangles.",
        hint: "Export it without compression.",
      });
    const key = JSON.stringify([packed, attributes, indices]);
    const decoded = this.#decoded.get(key) ?? this.#plain(packed, packed.attributes, attributes, decoder);
    this.#decoded.set(key, decoded);
    Object.assign(primitive, decoded);
  }

  #plain(packed: Json, ids: Json, attributes: Json, decoder: DracoDecoder): Json {
    const wanted = Object.entries(ids).flatMap(([name, id]) => {
      if (!(name in attributes)) return [];
      const accessor = this.#accessors[Number(attributes[name])];
      if (!accessor || !Number.isInteger(id)) throw damaged();
      const width = COMPONENTS[String(accessor.type)]!;
      return [{ name, accessor, id: Number(id), componentType: Number(accessor.componentType), width }];
    });
    const mesh: DracoMesh = decoder.decode(this.#stream(packed), wanted, MAX_NUMBERS - this.#numbers);
    this.#numbers += mesh.indices.length + wanted.reduce((sum, { width }) => sum + mesh.points * width, 0);
    const arrays = wanted.map(({ name, accessor }, i) => {
      const plain = { ...accessor, byteOffset: 0, count: mesh.points };
      return [name, this.#add(plain, mesh.attributes[i]!)];
    });
    const indices = { componentType: UINT32, type: "SCALAR", count: mesh.indices.length };
    return {
      attributes: { ...attributes, ...Object.fromEntries(arrays) },
      indices: this.#add(indices, new Uint8Array(mesh.indices.buffer)),
    };
  }

  /** The compressed bytes of a primitive. */
  #stream({ bufferView }: Json): Uint8Array {
    const view = this.#views[Number(bufferView)];
    if (view?.buffer !== 0 || records(this.document, "buffers")[0]!.uri !== undefined) throw damaged();
    const start = Number(view.byteOffset ?? 0);
    return this.binary.subarray(start, start + Number(view.byteLength));
  }

  /** Adds an array. Returns the index of its accessor. */
  #add(accessor: Json, bytes: Uint8Array): number {
    const view = { buffer: 0, byteOffset: this.#length, byteLength: bytes.length };
    this.#parts.push(bytes);
    this.#length += paddedLength(bytes.length);
    return this.#accessors.push({ ...accessor, bufferView: this.#views.push(view) - 1 }) - 1;
  }

  file(): Uint8Array<ArrayBuffer> {
    if (this.#parts.length > 1) records(this.document, "buffers")[0]!.byteLength = this.#length;
    return glbOf(this.document, this.#parts);
  }
}

const listed = (value: unknown): unknown[] => (Array.isArray(value) ? value : []);

function damaged(): StrutError {
  const message = "A compressed mesh of this model is damaged.";
  return new StrutError({ code: "bad-file", message, hint: "Export it again, or without compression." });
}
