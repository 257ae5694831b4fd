/** The online engine: one input frame in, one styled frame out. */
import type { Database } from "./database";
import { StrutError } from "./errors";
import { Handle } from "./handle";
import type { Stylizer as RawStylizer } from "./pkg/strut_wasm.js";
import {
  BODY_PARTS,
  type BodyPart,
  type DatabaseInfo,
  DEFAULT_OPTIONS,
  type ModelOptions,
  type Styled,
  type StyleWeights,
  type StylizeOptions,
} from "./types";
import { type Glue, guarded } from "./wasm";

/** One character's stream. */
export class Stylizer extends Handle<RawStylizer> {
  /** Classes in the order of {@link Styled.classWeights}. */
  readonly classes: DatabaseInfo["classes"];
  private readonly styles: readonly string[];
  private readonly actions: readonly string[];

  constructor(glue: Glue, database: Database, options: StylizeOptions = DEFAULT_OPTIONS) {
    super(
      guarded(() => new glue.Stylizer(database.raw)),
      "stylizer",
    );
    this.classes = database.info.classes;
    this.styles = database.info.styles;
    this.actions = database.info.actions;
    this.configure(options);
    this.setWeights(this.weightsOf(options.styles));
    for (const part of BODY_PARTS) {
      const own = options.parts[part];
      if (own) this.setPartWeights(part, this.weightsOf(own));
    }
  }

  /**
   * Replaces all options but the styles; the stream continues.
   * @throws StrutError `bad-input` for an option outside its range or a label that the database lacks
   */
  configure(options: ModelOptions): void {
    const { k, lambda, rho, kappa, delta, tempo, coherence, timing, footplant, method } = options;
    const action = options.action ? numberOf("action", options.action, this.actions) : undefined;
    const style = options.inputStyle ? numberOf("style", options.inputStyle, this.styles) : undefined;
    guarded(() =>
      this.raw.configure(k, lambda, rho, kappa, delta, tempo, coherence, timing, footplant, method, action, style),
    );
  }

  /** One weight per style of the database. @throws StrutError `bad-input` for a style that the database lacks */
  weightsOf(styles: StyleWeights): Float32Array {
    const weights = new Float32Array(this.styles.length);
    for (const [name, weight] of Object.entries(styles)) {
      weights[numberOf("style", name, this.styles)] = weight;
    }
    return weights;
  }

  /** Sets one weight per style; the remainder to a sum of 1 belongs to the neutral style. */
  setWeights(weights: Float32Array): void {
    guarded(() => this.raw.setStyles(weights));
  }

  /** Gives a part of the body its own weights; `undefined` makes it follow the whole body again. */
  setPartWeights(part: BodyPart, weights: Float32Array | undefined): void {
    guarded(() => this.raw.setPartStyles(BODY_PARTS.indexOf(part), weights ?? new Float32Array(0)));
  }

  /** Sets how far the next frames move from the input to the styles, 0 to 1: for input that the database does not cover. */
  setStyleShare(share: number): void {
    guarded(() => this.raw.setStyleShare(share));
  }

  /** Restarts at the next input frame, as after a cut. */
  reset(): void {
    guarded(() => this.raw.reset());
  }

  /**
   * Styles the next input frames, one database frame apart.
   * @param poses on the database's humanoid, a whole number of poses
   */
  push(poses: Float32Array): Styled {
    return guarded(() => {
      const styled = this.raw.push(poses);
      return {
        poses: styled,
        durations: this.raw.durations(),
        planted: this.raw.planted(),
        classWeights: this.raw.classWeights(),
      };
    });
  }
}

/** The index of a style or an action of the database. @throws StrutError `bad-input` if the database has none of this name */
function numberOf(what: string, name: string, names: readonly string[]): number {
  const number = names.indexOf(name);
  if (number >= 0) return number;
  throw new StrutError({
    code: "bad-input",
    message: `The database has no ${what} '${name}'.`,
    hint: `It has ${names.join(", ")}.`,
  });
}
