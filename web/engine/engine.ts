/** The engine on the calling thread. The worker runs it. */
import type { PackedMotions } from "./built_in";
import { ClipJob } from "./clip_job";
import { Database, type DatabaseSource } from "./database";
import { Input, type InputSource, packedFacts, readMotion } from "./input";
import type { PackedMotions as RawPackedMotions } from "./pkg/strut_wasm.js";
import { Stylizer } from "./stylizer";
import type { MotionFacts, StyleKey, StylizeOptions, WasmMemory } from "./types";
import { type Glue, guarded, loadWasm, wasmBytes } from "./wasm";

/** Opens databases and motions and creates stylizers, which the caller disposes of. Its calls are synchronous. */
export class Engine {
  /** Packed motions in the module's memory. Each set is stored once and shared by everything that is opened from it. */
  private readonly packed = new WeakMap<PackedMotions, RawPackedMotions>();

  private constructor(private readonly glue: Glue) {}

  /**
   * Loads the module, once per thread; after a fault, a fresh instance.
   * @throws StrutError if it cannot be loaded
   */
  static async load(): Promise<Engine> {
    return new Engine(await loadWasm());
  }

  openDatabase(source: DatabaseSource): Database {
    return source.kind === "demo"
      ? Database.fromPacked(this.glue, this.packedOf(source.motions))
      : Database.open(this.glue, source);
  }

  /** Names of the inputs among packed motions, the default first. */
  inputsOf(motions: PackedMotions): string[] {
    return guarded(() => this.packedOf(motions).inputs());
  }

  /** Facts of a motion's file. @throws StrutError `bad-file` or `bad-input` */
  readMotion(source: InputSource): MotionFacts {
    return source.kind === "built-in"
      ? packedFacts(this.glue, source, this.packedOf(source.motions))
      : readMotion(this.glue, source);
  }

  openInput(database: Database, source: InputSource): Input {
    return source.kind === "built-in"
      ? Input.fromPacked(this.glue, database, source, this.packedOf(source.motions))
      : Input.open(this.glue, database, source);
  }

  /** Memory of everything that is open on this thread. */
  memory(): WasmMemory {
    return { wasmBytes: wasmBytes() };
  }

  createStylizer(database: Database, options?: StylizeOptions): Stylizer {
    return new Stylizer(this.glue, database, options);
  }

  createClipJob(input: Input, stylizer: Stylizer, track: readonly StyleKey[] = []): ClipJob {
    return new ClipJob(this.glue, input, stylizer, track);
  }

  /** The pose between two poses, `t` from 0 to 1: the root linearly, rotations spherically. */
  interpolate(a: Float32Array, b: Float32Array, t: number): Float32Array {
    return guarded(() => this.glue.interpolatePoses(a, b, t));
  }

  private packedOf(motions: PackedMotions): RawPackedMotions {
    const known = this.packed.get(motions);
    if (known) return known;
    const raw = guarded(() => new this.glue.PackedMotions(motions));
    this.packed.set(motions, raw);
    return raw;
  }
}
