/** A crowd of walkers on the calling thread: a tick of a thousand takes milliseconds. */
import { StrutError } from "../errors";
import { Handle } from "../handle";
import { loadBuiltInWalkModel } from "../walk/built_in";
import type { FieldVertex, Place } from "./limits";
import { type CrowdGlue, crowdPackage } from "./wasm";

/** What a crowd begins with. */
export interface CrowdOptions {
  /** Walkers, 1 to 1,000. */
  count: number;
  /** Of all that is drawn by lot. */
  seed: number;
}

/** A crowd of walkers by one model. */
export class Crowd extends Handle<InstanceType<CrowdGlue["Crowd"]>> {
  private constructor(
    raw: InstanceType<CrowdGlue["Crowd"]>,
    private walkers: number,
    readonly styles: readonly string[],
    /** Bone offsets, 21 × xyz, metres. */
    readonly proportions: Float32Array,
    /** Ticks a second. */
    readonly rateHz: number,
  ) {
    super(raw, "crowd");
  }

  /**
   * A crowd by the model of a `.strutwalk` file, or of the built-in walks.
   * @throws StrutError if the module or the built-in model cannot be had, or with what is wrong with the file or the options
   */
  static async open(file: Uint8Array | undefined, { count, seed }: CrowdOptions): Promise<Crowd> {
    const [glue, bytes] = await Promise.all([crowdPackage.load(), file ?? loadBuiltInWalkModel()]);
    return crowdPackage.guarded(() => {
      const model = new glue.WalkModel(bytes);
      try {
        const raw = new glue.Crowd(model, count, seed);
        return new Crowd(raw, count, model.styles(), model.proportions(), model.rateHz());
      } finally {
        model.free();
      }
    });
  }

  get count(): number {
    return this.walkers;
  }

  /** Radius of the ground about the origin, metres; nobody goes farther than 1.2 times of it. */
  get radius(): number {
    return this.raw.radius();
  }

  /** Goes on by one frame of the model's rate. */
  tick(): void {
    crowdPackage.guarded(() => this.raw.tick());
  }

  /** Writes `CROWD_WALKER_FLOATS` floats a walker, and a byte a walker and style: its weight, of 255. */
  read(joints: Float32Array, weights: Uint8Array): void {
    crowdPackage.guarded(() => this.raw.read(joints, weights));
  }

  /** @throws StrutError if there are too few or too many */
  setCount(count: number): void {
    crowdPackage.guarded(() => this.raw.setCount(count));
    this.walkers = count;
  }

  /** Styles by place, from everybody's next step on. @throws StrutError if a vertex is none; nothing changes then */
  setField(vertices: readonly FieldVertex[]): void {
    const styles = vertices.map(({ style }) => {
      const number = this.styles.indexOf(style);
      if (number < 0)
        throw new StrutError({
          code: "bad-input",
          message: `The model has no style ${style}.`,
          hint: `It has ${this.styles.join(", ")}.`,
        });
      return number;
    });
    const numbers = vertices.flatMap(({ x, z, reach, intensity }) => [x, z, reach, intensity]);
    crowdPackage.guarded(() => this.raw.setField(Uint32Array.from(styles), Float32Array.from(numbers)));
  }

  /**
   * A way that everybody follows: round if its ends meet, else there and back; none sets them free.
   * @throws StrutError if it is none; nothing changes then
   */
  setRoute(points: readonly Place[]): void {
    crowdPackage.guarded(() => this.raw.setRoute(Float32Array.from(points.flat())));
  }

  /**
   * Bones that the joints lie on, 21 × xyz in metres, in place of {@link proportions}.
   * @throws StrutError if they are none; nothing changes then
   */
  setBones(offsets: Float32Array): void {
    crowdPackage.guarded(() => this.raw.setBones(offsets));
  }

  /** A BVH file of the next seconds of a walker, as if nobody else were there. */
  toBvh(walker: number, secs: number): string {
    return crowdPackage.guarded(() => this.raw.toBvh(walker, secs));
  }
}
