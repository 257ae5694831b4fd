/** Open objects of the lessons' worker: databases, inputs and lenses, each once. The least recently used is closed first. */
import type { PackedMotions } from "../../engine/built_in";
import type { Database } from "../../engine/database";
import type { Engine } from "../../engine/engine";
import { StrutError } from "../../engine/errors";
import type { Input } from "../../engine/input";
import { Lens, type LensOptions } from "../../engine/learn/lens";
import { Warps } from "../../engine/learn/warps";
import { builtInWithout, inputOfTake, turnedInput } from "../../engine/learn/wasm";
import { DEFAULT_OPTIONS } from "../../engine/types";
import type { LearnInput, Look } from "./protocol";

/** A page shows few figures at once; a database without some takes has 20 MB. */
const MOST = { databases: 2, inputs: 8, lenses: 6, warps: 1 };

/** A cache of objects by their keys. The least recently used is disposed of if there are too many. */
class Kept<T extends { dispose(): void }> {
  readonly #things = new Map<string, T>();

  constructor(private readonly most: number) {}

  get(key: string, open: () => T): T {
    const thing = this.#things.get(key) ?? open();
    // A map keeps the insertion order.
    this.#things.delete(key);
    this.#things.set(key, thing);
    const oldest = this.#things.entries().next().value;
    if (this.#things.size > this.most && oldest) {
      oldest[1].dispose();
      this.#things.delete(oldest[0]);
    }
    return thing;
  }
}

/** A lens, and the frame that it inspects. */
class Looking {
  #options = "";
  #styles = "";
  #frame = -1;

  constructor(
    readonly lens: Lens,
    private readonly styles: readonly string[],
  ) {}

  look({ styles, frame, options }: Look): Lens {
    const wanted: LensOptions = { ...LENS_OPTIONS, ...options };
    const [optionsKey, stylesKey] = [JSON.stringify(wanted), JSON.stringify(styles)];
    if (this.#styles !== stylesKey) this.lens.setStyles(weightsOf(this.styles, styles));
    this.#styles = stylesKey;
    if (this.#options !== optionsKey) this.lens.configure(wanted);
    this.#options = optionsKey;
    if (this.#frame !== frame) this.lens.at(frame);
    this.#frame = frame;
    return this.lens;
  }

  dispose(): void {
    this.lens.dispose();
  }
}

const { k, lambda, rho, kappa, delta, coherence } = DEFAULT_OPTIONS;
const LENS_OPTIONS: LensOptions = { k, lambda, rho, kappa, delta, coherence };

/** One weight per style. @throws StrutError `bad-input` for a style that the database lacks */
function weightsOf(names: readonly string[], styles: Look["styles"]): Float32Array {
  const unknown = Object.keys(styles).find((style) => !names.includes(style));
  if (unknown !== undefined)
    throw new StrutError({ code: "bad-input", message: `The database has no style '${unknown}'.`, hint: "" });
  return Float32Array.from(names, (name) => styles[name] ?? 0);
}

/** All open objects of the worker. */
export class Opened {
  readonly #heldOut = new Kept<Database>(MOST.databases);
  readonly #inputs = new Kept<Input>(MOST.inputs);
  readonly #lenses = new Kept<Looking>(MOST.lenses);
  readonly #warps = new Kept<Warps>(MOST.warps);
  readonly database: Database;

  constructor(
    readonly engine: Engine,
    readonly motions: PackedMotions,
  ) {
    this.database = engine.openDatabase({ kind: "demo", motions });
  }

  /** The database of an input. */
  databaseOf({ without = [] }: LearnInput): Database {
    if (without.length === 0) return this.database;
    return this.#heldOut.get(JSON.stringify(without), () => builtInWithout(without));
  }

  /** @throws StrutError `bad-input` if there is no input of this name */
  input(of: LearnInput): Input {
    return this.#inputs.get(keyOf(of), () => {
      const { name, turns = [], heading = 0 } = of;
      // All databases of the lessons have the same humanoid.
      const open = () => this.engine.openInput(this.database, { kind: "built-in", name, motions: this.motions });
      const plain = inputOfTake(this.database, name) ?? open();
      if (turns.length === 0 && heading === 0) return plain;
      const turned = turnedInput(this.database, plain, turns, heading);
      plain.dispose();
      return turned;
    });
  }

  /** A lens at the requested frame; the caller may use it until the next call. */
  look(look: Look): Lens {
    const { styles } = this.database.info;
    const open = () => {
      const database = this.databaseOf(look.input);
      return new Looking(new Lens(database, this.input(look.input), weightsOf(styles, look.styles)), styles);
    };
    return this.#lenses.get(keyOf(look.input), open).look(look);
  }

  /** The clips of an action. @throws StrutError `bad-input` if there is no action of this name */
  warps(action: string): Warps {
    return this.#warps.get(action, () => new Warps(this.database, this.database.info.actions.indexOf(action)));
  }
}

/** A regenerated database has inputs and lenses of its own. */
function keyOf({ name, turns = [], heading = 0, without = [] }: LearnInput): string {
  return JSON.stringify([name, turns, heading, without]);
}
