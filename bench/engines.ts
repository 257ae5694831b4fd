/** The engine compiled in two ways, and the interface of a reference implementation. */

import * as scalar from "./pkg/scalar/strut_bench.js";
import * as simd from "./pkg/simd/strut_bench.js";

/** The generated bindings of the packages that `scripts/wasm.mjs` builds. */
export type Glue = typeof simd;

/** An open database, and a stream of frames. */
export type Database = ReturnType<Glue["Database"]["fromBytes"]>;
export type Stylizer = simd.Stylizer;

/** The bindings of a package, and their instance of its module. */
export interface Instance {
  glue: Glue;
  memory(): WebAssembly.Memory;
  /** Restarts with empty memory: objects of the bindings become invalid. */
  restart(): void;
}

/** One instance of each package. */
export interface Instances {
  simd: Instance;
  scalar: Instance;
}

/** Computes the stages of a frame without state from earlier frames. */
export interface Yardstick {
  /**
   * Finds the nearest windows of the classes from `fromClass` up to `toClass`.
   * @param frames positions of the joints in the last five frames, 5 × 21 × 3
   */
  search(frames: Float32Array, fromClass: number, toClass: number): void;
  /**
   * Returns the next row from xₜ, xₜ₋₁ and yₜ₋₁ and the neighbours found last.
   * @param leastWeight least weight of a class in use, relative to the largest
   */
  predict(x: Float32Array, xBefore: Float32Array, yBefore: Float32Array, leastWeight: number): Float32Array;
  /** Returns the duration of the frame that was predicted last, seconds, from xₜ, xₜ₋₁, yₜ and yₜ₋₁. */
  duration(x: Float32Array, xBefore: Float32Array, y: Float32Array, yBefore: Float32Array): number;
  /**
   * Returns the probability of contact of the left and the right foot in the last of the frames: the vote of the
   * classes that were used in the last prediction.
   */
  contacts(frames: Float32Array): ArrayLike<number>;
  /** Returns the rows of a class's neighbours, nearest first, … */
  neighbours(label: number): ArrayLike<number>;
  /** … and their distances, m². */
  distances(label: number): ArrayLike<number>;
}

/** Loads both packages. @param compile compiles the module in the file at an address */
export async function loadInstances(compile: (url: URL) => Promise<WebAssembly.Module>): Promise<Instances> {
  const modules = await Promise.all([
    compile(new URL("./pkg/simd/strut_bench_bg.wasm", import.meta.url)),
    compile(new URL("./pkg/scalar/strut_bench_bg.wasm", import.meta.url)),
  ]);
  return {
    simd: instanceOf(simd, modules[0]),
    // Built from the same source: the types differ only in where they are declared.
    scalar: instanceOf(scalar as unknown as Glue, modules[1]),
  };
}

function instanceOf(glue: Glue, module: WebAssembly.Module): Instance {
  // Returns the existing instance if there is one.
  const memory = () => glue.initSync({ module }).memory;
  memory();
  return { glue, memory, restart: () => glue.__wbg_reset_state() };
}
