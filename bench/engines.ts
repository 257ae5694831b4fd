/** The engine compiled two ways, and what a yardstick must be able to do. */

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
  /** Begins anew with empty memory: what the bindings hold is lost. */
  restart(): void;
}

/** One instance of each package. */
export interface Instances {
  simd: Instance;
  scalar: Instance;
}

/** Does what a frame is made of, with no memory of the frames before. */
export interface Yardstick {
  /**
   * Finds the nearest windows of the classes from `fromClass` up to `toClass`.
   * @param frames positions of the joints in the last five frames, 5 × 21 × 3
   */
  search(frames: Float32Array, fromClass: number, toClass: number): void;
  /**
   * The next row from xₜ, xₜ₋₁ and yₜ₋₁ and the neighbours found last.
   * @param leastWeight share of the largest weight from which on a class takes part
   */
  predict(x: Float32Array, xBefore: Float32Array, yBefore: Float32Array, leastWeight: number): Float32Array;
  /** How long the frame lasts that was predicted last, seconds, from xₜ, xₜ₋₁, yₜ and yₜ₋₁. */
  duration(x: Float32Array, xBefore: Float32Array, y: Float32Array, yBefore: Float32Array): number;
  /**
   * Likelihood that the left and the right foot is planted in the last of the frames: the vote of the classes that took
   * part in the last prediction.
   */
  contacts(frames: Float32Array): ArrayLike<number>;
  /** Rows of a class's neighbours, nearest first, … */
  neighbours(label: number): ArrayLike<number>;
  /** … and their distances, m². */
  distances(label: number): ArrayLike<number>;
}

/** Loads both packages. @param compile makes a module of the file at an address */
export async function loadInstances(compile: (url: URL) => Promise<WebAssembly.Module>): Promise<Instances> {
  const modules = await Promise.all([
    compile(new URL("./pkg/simd/strut_bench_bg.wasm", import.meta.url)),
    compile(new URL("./pkg/scalar/strut_bench_bg.wasm", import.meta.url)),
  ]);
  return {
    simd: instanceOf(simd, modules[0]),
    // Built from the same source: the types differ in nothing but where they were declared.
    scalar: instanceOf(scalar as unknown as Glue, modules[1]),
  };
}

function instanceOf(glue: Glue, module: WebAssembly.Module): Instance {
  // Where there is an instance, it is returned.
  const memory = () => glue.initSync({ module }).memory;
  memory();
  return { glue, memory, restart: () => glue.__wbg_reset_state() };
}
