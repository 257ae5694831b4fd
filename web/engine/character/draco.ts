/**
 * Google's decoder of Draco meshes, as shipped with three.js: the WASM module alone. The script that comes with it
 * cannot be imported as a module and has no limit on the memory of a mesh.
 */
import { assetOf } from "../assets";
import { StrutError, toStrutError } from "../errors";
import { compileModule } from "../module";

/** Short export names of the module's functions, by their names in `draco_wasm_wrapper.js`, the script that comes with it. */
export const EXPORTS = {
  malloc: "Qb",
  free: "Rb",
  emscripten_bind_Mesh_Mesh_0: "P",
  emscripten_bind_Mesh_num_faces_0: "Q",
  emscripten_bind_Mesh_num_points_0: "S",
  emscripten_bind_Mesh___destroy___0: "T",
  emscripten_bind_PointAttribute_num_components_0: "v",
  emscripten_bind_Status_ok_0: "X",
  emscripten_bind_Decoder_Decoder_0: "Ja",
  emscripten_bind_Decoder_DecodeArrayToMesh_3: "La",
  emscripten_bind_Decoder_GetAttributeByUniqueId_2: "Qa",
  emscripten_bind_Decoder_GetTrianglesUInt32Array_3: "Wa",
  emscripten_bind_Decoder_GetAttributeDataArrayForAllPoints_5: "eb",
} as const;
/** The exports for the memory and for the initialisation that runs first. They have no names in the script. */
const [MEMORY, INITIALIZE] = ["e", "f"];

/** Draco's number of a component type, and its size in bytes, by glTF's number. */
const TYPES: Readonly<Record<number, readonly [type: number, bytes: number]>> = {
  5120: [1, 1],
  5121: [2, 1],
  5122: [3, 2],
  5123: [4, 2],
  5125: [6, 4],
  5126: [9, 4],
};
/** Largest memory of the module, bytes. Two million triangles take half of it. A stream that declares billions is refused. */
const MAX_MEMORY = 512 * 1024 * 1024;
const PAGE = 65_536;

/** The module's name in messages, and what to do without it. */
const WHAT = "decoder of Draco meshes";
const HINT = "Export the model without Draco, or check that draco_decoder.wasm exists and can be fetched.";

type Call = (...given: number[]) => number;

/** An attribute that is to be decoded. */
interface WantedAttribute {
  /** Its number in the stream. */
  readonly id: number;
  /** glTF's number of its component type. */
  readonly componentType: number;
  /** Components per element. */
  readonly width: number;
}

/** A mesh in plain arrays. */
export interface DracoMesh {
  /** Three per triangle. */
  readonly indices: Uint32Array<ArrayBuffer>;
  readonly points: number;
  /** The bytes of each requested attribute. */
  readonly attributes: readonly Uint8Array<ArrayBuffer>[];
}

/** A decoder for the meshes of one file. Its memory is freed with it. */
export class DracoDecoder {
  readonly #memory: WebAssembly.Memory;
  readonly #call: Readonly<Record<keyof typeof EXPORTS, Call>>;
  readonly #decoder: number;

  private constructor({ exports }: WebAssembly.Instance) {
    this.#memory = exports[MEMORY] as WebAssembly.Memory;
    const calls = Object.entries(EXPORTS).map(([name, short]) => [name, exports[short]]);
    this.#call = Object.fromEntries(calls) as Record<keyof typeof EXPORTS, Call>;
    (exports[INITIALIZE] as Call)();
    this.#decoder = this.#call.emscripten_bind_Decoder_Decoder_0();
  }

  /** @throws StrutError `load` if the module cannot be loaded, `unsupported` */
  static async load(): Promise<DracoDecoder> {
    const beside = () =>
      new URL("../../../node_modules/three/examples/jsm/libs/draco/gltf/draco_decoder.wasm", import.meta.url);
    const module = await compileModule(assetOf("draco_decoder.wasm", beside), WHAT).catch((thrown: unknown) => {
      const { code, message, hint } = toStrutError(thrown);
      throw new StrutError({ code, message, hint: code === "load" ? HINT : hint }, thrown);
    });
    const memory = () => instance.exports[MEMORY] as WebAssembly.Memory;
    const stop = () => {
      throw damaged();
    };
    // What the module imports: abort, throw, grow the memory, copy within it.
    const environment = {
      a: stop,
      b: stop,
      c: (bytes: number) => grow(memory(), bytes >>> 0),
      d: (to: number, from: number, bytes: number) => {
        new Uint8Array(memory().buffer).copyWithin(to, from, from + bytes);
      },
    };
    const instance = await WebAssembly.instantiate(module, { a: environment });
    return new DracoDecoder(instance);
  }

  /**
   * Decodes a mesh.
   * @param limit maximum number of values in the decoded mesh
   * @throws StrutError `bad-file` if the stream is damaged, has other attributes, or is too long; the decoder cannot be
   * used afterwards
   */
  decode(stream: Uint8Array, wanted: readonly WantedAttribute[], limit: number): DracoMesh {
    try {
      return this.#decode(stream, wanted, limit);
    } catch (cause) {
      // A damaged stream can make the module throw anything.
      throw cause instanceof StrutError ? cause : damaged(cause);
    }
  }

  #decode(stream: Uint8Array, wanted: readonly WantedAttribute[], limit: number): DracoMesh {
    const call = this.#call;
    const mesh = call.emscripten_bind_Mesh_Mesh_0();
    const isDecoded = this.#with(stream.length, (at) => {
      new Uint8Array(this.#memory.buffer).set(stream, at);
      const status = call.emscripten_bind_Decoder_DecodeArrayToMesh_3(this.#decoder, at, stream.length, mesh);
      return call.emscripten_bind_Status_ok_0(status);
    });
    if (!isDecoded) throw isOutdated(stream) ? outdated(stream) : damaged();
    const indices = 3 * call.emscripten_bind_Mesh_num_faces_0(mesh);
    const points = call.emscripten_bind_Mesh_num_points_0(mesh);
    const numbers = indices + wanted.reduce((sum, { width }) => sum + points * width, 0);
    if (!(numbers <= limit)) throw tooLong();
    const triangles = this.#filled(4 * indices, (at, bytes) =>
      call.emscripten_bind_Decoder_GetTrianglesUInt32Array_3(this.#decoder, mesh, bytes, at),
    );
    const attributes = wanted.map(({ id, componentType, width }) => {
      const attribute = call.emscripten_bind_Decoder_GetAttributeByUniqueId_2(this.#decoder, mesh, id);
      if (attribute === 0 || call.emscripten_bind_PointAttribute_num_components_0(attribute) !== width) throw damaged();
      const [type, bytesEach] = TYPES[componentType]!;
      return this.#filled(points * width * bytesEach, (at, bytes) =>
        call.emscripten_bind_Decoder_GetAttributeDataArrayForAllPoints_5(
          this.#decoder,
          mesh,
          attribute,
          type,
          bytes,
          at,
        ),
      );
    });
    call.emscripten_bind_Mesh___destroy___0(mesh);
    return { indices: new Uint32Array(triangles.buffer), points, attributes };
  }

  /** Returns a copy of the bytes that `fill` writes. `fill` returns whether it succeeded. */
  #filled(bytes: number, fill: (at: number, bytes: number) => number): Uint8Array<ArrayBuffer> {
    return this.#with(bytes, (at) => {
      if (!fill(at, bytes)) throw damaged();
      return new Uint8Array(this.#memory.buffer).slice(at, at + bytes);
    });
  }

  /** Calls `use` with a temporary allocation in the module's memory. */
  #with<T>(bytes: number, use: (at: number) => T): T {
    const at = this.#call.malloc(bytes);
    if (at === 0 && bytes > 0) throw damaged();
    const result = use(at);
    this.#call.free(at);
    return result;
  }
}

/** Grows a memory to `bytes`, and by at least a fifth. Returns whether it succeeded. @throws StrutError `bad-file` */
function grow(memory: WebAssembly.Memory, bytes: number): number {
  if (bytes > MAX_MEMORY) throw tooLong();
  const had = memory.buffer.byteLength;
  const wanted = Math.min(MAX_MEMORY, Math.max(bytes, 1.2 * had));
  try {
    memory.grow(Math.ceil((wanted - had) / PAGE));
    return 1;
  } catch {
    return 0;
  }
}

/** Whether a stream has an earlier version of the format, which this decoder does not read. */
const isOutdated = (stream: Uint8Array): boolean =>
  new TextDecoder("latin1").decode(stream.subarray(0, 5)) === "DRACO" && (stream[5]! < 2 || stream[6]! < 2);

function outdated([, , , , , major, minor]: Uint8Array): StrutError {
  const message = `The meshes of this model are compressed with Draco's format ${major}.${minor}; only 2.2 is supported.`;
  return new StrutError({ code: "bad-file", message, hint: "Export it again with a program from 2018 or later." });
}

function tooLong(): StrutError {
  const message = "The compressed meshes of this model are too large.";
  return new StrutError({ code: "bad-file", message, hint: "Simplify its meshes." });
}

function damaged(cause?: unknown): StrutError {
  const message = "A compressed mesh of this model is damaged.";
  return new StrutError({ code: "bad-file", message, hint: "Export it again, or without compression." }, cause);
}
