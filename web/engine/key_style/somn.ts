/** Learning of a key-style model, update by update, for display: a self-organising mixture network. */
import { Handle } from "../handle";
import { type KeyStyleGlue, keyStylePackage } from "./wasm";

/** Floats before those of the components; `rust/strut-wasm/src/key_style` defines the layout. */
const HEAD = 5;
/** The seed that training uses, `somn::SEED` of the core. */
const SEED = 0;

/** Settings of a {@link Somn}. */
export interface SomnOptions {
  /** Number of components, 1 to 64; if missing, the number that training uses. */
  components?: number;
  /** Random seed, a whole number from 0; if missing, the seed that training uses. */
  seed?: number;
  /** Whether maps and shares are updated with the signs printed in the paper (Eq. 7 and 8), which diverges. */
  asPrinted?: boolean;
}

/** The state after an update; the arrays are views that the next call overwrites. */
export interface SomnState {
  /** Number of updates so far. */
  updates: number;
  /** The training frame of the last update; −1 before the first. */
  sample: number;
  /** Responsibility of each component for that sample; sums to 1, and is 0 before the first update. */
  readonly r: Float32Array;
  /** Mean m of each component in the style variables, component after component. */
  readonly centres: Float32Array;
  /** Their standard deviations, the roots of S, which is diagonal during learning; same layout. */
  readonly spreads: Float32Array;
  /** Shares a. */
  readonly weights: Float32Array;
  /**
   * Prediction error of the poses of the current pass, each before its update: root mean square over the numbers of a
   * pose, radians. Infinite or NaN once learning has diverged.
   */
  error: number;
  /** Width σ of the neighbourhood, radians. */
  sigma: number;
  /** Learning rate δ. */
  delta: number;
}

type RawModel = InstanceType<KeyStyleGlue["KeyStyleModel"]>;

/** The model from whose training frames the run learns. */
interface Trained {
  readonly raw: RawModel;
  readonly axes: readonly unknown[];
  readonly values: ArrayLike<number>;
}

/** A learning run, and the models made from it. */
export class Somn<Model> extends Handle<InstanceType<KeyStyleGlue["Somn"]>> {
  readonly components: number;
  /** Number of updates in a pass, and in all passes. */
  readonly frames: number;
  readonly updates: number;
  /** The current state; every call overwrites it. */
  readonly state: SomnState;
  private readonly floats: Float32Array;

  /** @param open makes a model from the package's object */
  constructor(
    model: Trained,
    glue: KeyStyleGlue,
    private readonly open: (make: () => RawModel) => Model,
    { components = 0, seed = SEED, asPrinted = false }: SomnOptions = {},
  ) {
    super(
      keyStylePackage.guarded(() => new glue.Somn(model.raw, components, seed, asPrinted)),
      "learning run",
    );
    const axes = model.axes.length;
    this.components = this.raw.components();
    this.updates = this.raw.updates();
    this.frames = model.values.length / axes;
    this.floats = new Float32Array(HEAD + this.components * (2 + 2 * axes));
    let begin = HEAD;
    const next = (numbers: number) => {
      begin += this.components * numbers;
      return this.floats.subarray(begin - this.components * numbers, begin);
    };
    const [r, weights, centres, spreads] = [next(1), next(1), next(axes), next(axes)];
    this.state = { updates: 0, sample: -1, r, weights, centres, spreads, error: 0, sigma: 0, delta: 0 };
    this.step(0);
  }

  /** Makes `n` updates, or the remaining ones if they are fewer; none once learning has diverged. */
  step(n: number): SomnState {
    keyStylePackage.guarded(() => this.raw.step(n));
    const { state, floats } = this;
    this.raw.read(floats);
    [state.updates, state.sample, state.error, state.sigma, state.delta] = floats as unknown as SomnHead;
    return state;
  }

  /** The model of the current components, as if learning ended here. The caller disposes of it. */
  model(): Model {
    return this.open(() => this.raw.soFar());
  }
}

type SomnHead = [updates: number, sample: number, error: number, sigma: number, delta: number];
