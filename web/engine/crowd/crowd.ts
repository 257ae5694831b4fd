/** A crowd on the calling thread. A tick of a thousand agents takes milliseconds. */
import { StrutError } from "../errors";
import { Handle } from "../handle";
import { type PerformersGlue, performersPackage } from "../performers/wasm";
import { loadBuiltInWalkModel } from "../walk/built_in";
import type { FieldVertex, People, Place, Recorded, Walkers } from "./limits";
import { type CrowdGlue, crowdPackage } from "./wasm";

/** Initial settings of a crowd. */
interface CrowdOptions {
  /** Number of agents, 1 to 1,000. */
  count: number;
  /** Seed of all random choices. */
  seed: number;
}

/** Both classes have the same methods. */
type Raw = InstanceType<CrowdGlue["Crowd"]> | InstanceType<PerformersGlue["Performers"]>;
type Package = Pick<typeof crowdPackage, "guarded">;

/** A crowd of agents that walk by a walk model, or of agents that perform one motion. */
export class Crowd extends Handle<Raw> {
  private constructor(
    raw: Raw,
    private readonly itsPackage: Package,
    private people: number,
    readonly styles: readonly string[],
    /** Bone offsets, 21 × xyz, metres. */
    readonly proportions: Float32Array,
    /** Ticks per second. */
    readonly rateHz: number,
  ) {
    super(raw, "crowd");
  }

  /** @throws StrutError if a module or a model cannot be loaded, or if the agents or the options are invalid */
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

  /** Radius of the ground about the origin, metres. Agents stay within 1.2 times this radius. */
  get radius(): number {
    return this.raw.radius();
  }

  /** Advances by one tick. */
  tick(): void {
    this.itsPackage.guarded(() => this.raw.tick());
  }

  /** Writes `CROWD_WALKER_FLOATS` floats per agent, and one byte per agent and style: its weight, 0 to 255. */
  read(joints: Float32Array, weights: Uint8Array): void {
    this.itsPackage.guarded(() => this.raw.read(joints, weights));
  }

  /** @throws StrutError if there are too few or too many */
  setCount(count: number): void {
    this.itsPackage.guarded(() => this.raw.setCount(count));
    this.people = count;
  }

  /**
   * Sets the styles by place, from each agent's next step on, or from now on for agents that perform a motion.
   * @throws StrutError if a vertex is invalid; nothing changes then
   */
  setField(vertices: readonly FieldVertex[]): void {
    const styles = vertices.map(({ style }) => {
      const number = this.styles.indexOf(style);
      if (number < 0)
        throw new StrutError({
          code: "bad-input",
          message: `There is no style ${style}.`,
          hint: `Styles: ${this.styles.join(", ")}.`,
        });
      return number;
    });
    const numbers = vertices.flatMap(({ x, z, reach, intensity }) => [x, z, reach, intensity]);
    this.itsPackage.guarded(() => this.raw.setField(Uint32Array.from(styles), Float32Array.from(numbers)));
  }

  /**
   * Sets a route that all agents follow: a loop if its ends meet, otherwise back and forth. An empty one removes the
   * route.
   * @throws StrutError if it is invalid; nothing changes then
   */
  setRoute(points: readonly Place[]): void {
    this.itsPackage.guarded(() => this.raw.setRoute(Float32Array.from(points.flat())));
  }

  /**
   * Sets the bones on which the joints are computed, 21 × xyz in metres, instead of {@link proportions}.
   * @throws StrutError if they are invalid; nothing changes then
   */
  setBones(offsets: Float32Array): void {
    this.itsPackage.guarded(() => this.raw.setBones(offsets));
  }

  /** A BVH file of an agent's next seconds, without interaction with other agents. */
  toBvh(person: number, secs: number): string {
    return this.itsPackage.guarded(() => this.raw.toBvh(person, secs));
  }
}
