/** A crowd on the calling thread: a tick of a thousand takes milliseconds. */
import { StrutError } from "../errors";
import { Handle } from "../handle";
import { type PerformersGlue, performersPackage } from "../performers/wasm";
import { loadBuiltInWalkModel } from "../walk/built_in";
import type { FieldVertex, People, Place, Recorded, Walkers } from "./limits";
import { type CrowdGlue, crowdPackage } from "./wasm";

/** What a crowd begins with. */
export interface CrowdOptions {
  /** People, 1 to 1,000. */
  count: number;
  /** Of all that is drawn by lot. */
  seed: number;
}

/** Both kinds can be asked the same. */
type Raw = InstanceType<CrowdGlue["Crowd"]> | InstanceType<PerformersGlue["Performers"]>;
type Package = Pick<typeof crowdPackage, "guarded">;

/** Walkers by one model, or people who perform one motion. */
export class Crowd extends Handle<Raw> {
  private constructor(
    raw: Raw,
    private readonly itsPackage: Package,
    private people: number,
    readonly styles: readonly string[],
    /** Bone offsets, 21 × xyz, metres. */
    readonly proportions: Float32Array,
    /** Ticks a second. */
    readonly rateHz: number,
  ) {
    super(raw, "crowd");
  }

  /** @throws StrutError if a module or a model cannot be had, or with what is wrong with the people or the options */
  static open(people: People, options: CrowdOptions): Promise<Crowd> {
    return people.kind === "performers" ? Crowd.performers(people.recorded, options) : Crowd.walkers(people, options);
  }

  private static async walkers({ model: file }: Walkers, { count, seed }: CrowdOptions): Promise<Crowd> {
    const [glue, bytes] = await Promise.all([crowdPackage.load(), file ?? loadBuiltInWalkModel()]);
    return crowdPackage.guarded(() => {
      const model = new glue.WalkModel(bytes);
      try {
        const raw = new glue.Crowd(model, count, seed);
        return new Crowd(raw, crowdPackage, count, model.styles(), model.proportions(), model.rateHz());
      } finally {
        model.free();
      }
    });
  }

  private static async performers({ styles, numbers }: Recorded, { count, seed }: CrowdOptions): Promise<Crowd> {
    const glue = await performersPackage.load();
    return performersPackage.guarded(() => {
      const raw = new glue.Performers(numbers, count, seed);
      return new Crowd(raw, performersPackage, count, styles, raw.proportions(), raw.rateHz());
    });
  }

  get count(): number {
    return this.people;
  }

  /** Radius of the ground about the origin, metres; nobody goes farther than 1.2 times of it. */
  get radius(): number {
    return this.raw.radius();
  }

  /** Goes on by one tick. */
  tick(): void {
    this.itsPackage.guarded(() => this.raw.tick());
  }

  /** Writes `CROWD_WALKER_FLOATS` floats a person, and a byte a person and style: its weight, of 255. */
  read(joints: Float32Array, weights: Uint8Array): void {
    this.itsPackage.guarded(() => this.raw.read(joints, weights));
  }

  /** @throws StrutError if there are too few or too many */
  setCount(count: number): void {
    this.itsPackage.guarded(() => this.raw.setCount(count));
    this.people = count;
  }

  /** Styles by place, from everybody's next step on, or from now on for performers. @throws StrutError if a vertex is none; nothing changes then */
  setField(vertices: readonly FieldVertex[]): void {
    const styles = vertices.map(({ style }) => {
      const number = this.styles.indexOf(style);
      if (number < 0)
        throw new StrutError({
          code: "bad-input",
          message: `There is no style ${style}.`,
          hint: `There are ${this.styles.join(", ")}.`,
        });
      return number;
    });
    const numbers = vertices.flatMap(({ x, z, reach, intensity }) => [x, z, reach, intensity]);
    this.itsPackage.guarded(() => this.raw.setField(Uint32Array.from(styles), Float32Array.from(numbers)));
  }

  /**
   * A way that everybody follows: round if its ends meet, else there and back; none sets them free.
   * @throws StrutError if it is none; nothing changes then
   */
  setRoute(points: readonly Place[]): void {
    this.itsPackage.guarded(() => this.raw.setRoute(Float32Array.from(points.flat())));
  }

  /**
   * Bones that the joints lie on, 21 × xyz in metres, in place of {@link proportions}.
   * @throws StrutError if they are none; nothing changes then
   */
  setBones(offsets: Float32Array): void {
    this.itsPackage.guarded(() => this.raw.setBones(offsets));
  }

  /** A BVH file of the next seconds of somebody, as if nobody else were there. */
  toBvh(person: number, secs: number): string {
    return this.itsPackage.guarded(() => this.raw.toBvh(person, secs));
  }
}
