/**
 * Google's decoder of Draco meshes, as three.js has it: the WASM module alone. The script that comes with it can neither be
 * imported as a module nor be told how much memory a mesh may take.
 */
import { assetOf } from "../assets";
import { StrutError, toStrutError } from "../errors";
import { compileModule } from "../module";

/** What the module calls its functions, by their names in `draco_wasm_wrapper.js`, the script that comes with it. */
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
/** Its memory and what runs before everything else, which have no names in the script. */
const [MEMORY, INITIALIZE] = ["e", "f"];

/** Draco's number of a type of numbers, and their bytes, by glTF's number. */
const TYPES: Readonly<Record<number, readonly [type: number, bytes: number]>> = {
  5120: [1, 1],
  5121: [2, 1],
  5122: [3, 2],
  5123: [4, 2],
  5125: [6, 4],
  5126: [9, 4],
};
/** Most bytes of the module's memory. Two million triangles take half; a stream that tells of billions gets none for them. */
const MAX_MEMORY = 512 * 1024 * 1024;
const PAGE = 65_536;

/** What the module is called in messages, and what to do without it. */
const WHAT = "decoder of Draco meshes";
const HINT = "Export the model without Draco, or see that draco_decoder.wasm is there and may be fetched.";

type Call = (...given: number[]) => number;

/** An attribute as it is wanted. */
export interface WantedAttribute {
  /** Its number in the stream. */
  readonly id: number;
  /** glTF's number of the type of its components. */
  readonly componentType: number;
  /** Components an element. */
  readonly width: number;
}

/** A mesh in plain arrays. */
export interface DracoMesh {
  /** Three a triangle. */
  readonly indices: Uint32Array<ArrayBuffer>;
  readonly points: number;
  /** The bytes of each wanted attribute. */
  readonly attributes: readonly Uint8Array<ArrayBuffer>[];
}

/** A decoder for the meshes of one file. Its memory goes with it. */
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

  /** @throws StrutError `load` if the module cannot be had, `unsupported` */
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
   * @param limit most numbers of what is decoded
   * @throws StrutError `bad-file` where the stream is damaged, has other attributes, or is too long; the decoder is of no use then
   */
  decode(stream: Uint8Array, wanted: readonly WantedAttribute[], limit: number): DracoMesh {
    try {
      return this.#decode(stream, wanted, limit);
    } catch (cause) {
      // Whatever a damaged stream makes the module do.
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

  /** A copy of the bytes that a function writes; it says whether it could. */
  #filled(bytes: number, fill: (at: number, bytes: number) => number): Uint8Array<ArrayBuffer> {
    return this.#with(bytes, (at) => {
      if (!fill(at, bytes)) throw damaged();
      return new Uint8Array(this.#memory.buffer).slice(at, at + bytes);
    });
  }

  /** Runs with bytes of the module's memory. */
  #with<T>(bytes: number, use: (at: number) => T): T {
    const at = this.#call.malloc(bytes);
    if (at === 0 && bytes > 0) throw damaged();
    const result = use(at);
    this.#call.free(at);
    return result;
  }
}

/** Lets a memory grow to so many bytes, and by a fifth at least. Gives whether it could. @throws StrutError `bad-file` */
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

/** Whether a stream is of an earlier version of the format, which this decoder does not read. */
const isOutdated = (stream: Uint8Array): boolean =>
  new TextDecoder("latin1").decode(stream.subarray(0, 5)) === "DRACO" && (stream[5]! < 2 || stream[6]! < 2);

function outdated([, , , , , major, minor]: Uint8Array): StrutError {
  const message = `The meshes of this model are compressed with Draco's format ${major}.${minor}; 2.2 can be read.`;
  return new StrutError({ code: "bad-file", message, hint: "Export it again with a program of 2018 or later." });
}

function tooLong(): StrutError {
  const message = "The compressed meshes of this model are too long.";
  return new StrutError({ code: "bad-file", message, hint: "Simplify its meshes." });
}

function damaged(cause?: unknown): StrutError {
  const message = "A compressed mesh of this model is damaged.";
  return new StrutError({ code: "bad-file", message, hint: "Export it again, or without compression." }, cause);
}
