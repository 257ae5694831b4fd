/** A batch's own engine, so that playback continues. */
import { bvhBytes } from "../../client/bvh_bytes";
import { EngineClient } from "../../client/engine_client";
import type { ClientDatabase } from "../../client/handles";
import type { CallOptions, DatabaseSource, RememberedReadings } from "../../client/protocol";
import type { Lane, OpenClip } from "./batch";
import type { Variant } from "./variants";

/** Each has the database in its memory. */
const MOST_LANES = 4;

/** Number of lanes for the cores of this machine that the page, its engine and its picture leave free. */
export function laneCount(cores = navigator.hardwareConcurrency || 2): number {
  return Math.min(MOST_LANES, Math.max(1, cores - 2));
}

export class EngineLane implements Lane {
  private constructor(
    private readonly engine: EngineClient,
    private readonly database: ClientDatabase,
    private readonly remembered: RememberedReadings,
  ) {}

  /** @throws StrutError as `EngineClient.openDatabase` */
  static async start(
    source: DatabaseSource,
    remembered: RememberedReadings,
    call: CallOptions = {},
  ): Promise<EngineLane> {
    const engine = new EngineClient(source.kind === "demo" ? { preload: "built-in" } : {});
    try {
      return new EngineLane(engine, await engine.openDatabase(source, call), remembered);
    } catch (thrown) {
      engine.dispose();
      throw thrown;
    }
  }

  async open(name: string, bytes: Uint8Array<ArrayBuffer>, call: CallOptions): Promise<OpenClip> {
    const { engine, database, remembered } = this;
    const source = { kind: "bvh" as const, name, bytes: bytes.slice().buffer, remembered };
    const motion = await engine.openMotion(source, call);
    try {
      await motion.on(database, call);
    } catch (thrown) {
      motion.dispose();
      throw thrown;
    }
    return {
      style: async ({ options }: Variant, styling: CallOptions) =>
        bvhBytes((await motion.stylize(database, options, true, styling)).bvh),
      dispose: () => motion.dispose(),
    };
  }

  dispose(): void {
    this.engine.dispose();
  }
}
