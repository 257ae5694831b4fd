/** The engine under a stop-watch. */
import { batchFor, clockResolution, timed } from "./clock";
import type { Database, Glue, Instance, Stylizer } from "./engines";
import { type EngineName, type Mode, type Report, summarise } from "./report";
import { POSE_FLOATS, type Query, type Workload } from "./workload";

/** Frames of every query that are measured, and those before them that are not. */
const FRAMES = 80;
export const WARM_UP = 20;
/** Frames between two at which a search starts cold. */
const COLD_STRIDE = 20;
/** A clock with this resolution sees every stage of a frame. */
const FINE_CLOCK_MS = 0.001;
/** Times a database is opened. */
const OPENINGS = 3;

/** Share of the largest weight from which on a class takes part. */
export const LEAST_WEIGHT: Record<Mode, number> = { labelled: 1e-4, unlabelled: 1e-4, all: 0 };

/** A stylizer set up for a query: towards the neutral style, as good a target as any. */
export function stylizerFor(glue: Glue, database: Database, mode: Mode, query: Query): Stylizer {
  const stylizer = new glue.Stylizer(database);
  const [action, style] = mode === "labelled" ? [query.action, query.style] : [-1, -1];
  stylizer.setClasses(action, style, LEAST_WEIGHT[mode]);
  return stylizer;
}

/** One build of the engine with the workload's database open. */
export class EngineBench {
  private readonly database: Database;
  private readonly classes: number;
  private readonly resolution = clockResolution();

  /** Opens the database and says how long it took and how much memory it needs. */
  constructor(
    private readonly instance: Instance,
    private readonly engine: EngineName,
    private readonly workload: Workload,
    private readonly report: Report,
  ) {
    const { glue } = instance;
    const openings: number[] = [];
    let opened: Database | undefined;
    for (let i = 0; i < OPENINGS; i++) {
      opened?.free();
      openings.push(
        timed(() => {
          opened = glue.Database.fromBytes(workload.bytes);
        }),
      );
    }
    this.database = opened!;
    this.classes = this.database.classes().length / 3;
    this.add("open", "all", openings);
  }

  /** Styles every query: for the whole frames, with a look at each stage, and here and there from a cold start. */
  measure(mode: Mode, turn: () => void): void {
    const { glue } = this.instance;
    const names = glue.stageNames();
    const samples = new Map<string, number[]>(["frame", ...names, "cold search"].map((stage) => [stage, []]));
    for (const query of this.workload.queries) {
      turn();
      const poses = (from: number, to: number) => query.poses.subarray(from * POSE_FLOATS, to * POSE_FLOATS);
      const end = Math.min(query.frames, WARM_UP + FRAMES);
      const whole = stylizerFor(glue, this.database, mode, query);
      const warm = timed(() => whole.push(poses(0, WARM_UP)));
      const batch = batchFor(warm / WARM_UP, this.resolution);
      for (let frame = WARM_UP; frame < end; frame += batch) {
        const next = Math.min(frame + batch, end);
        const ms = timed(() => whole.push(poses(frame, next)));
        samples.get("frame")!.push(ms / (next - frame));
      }
      whole.free();

      const staged = stylizerFor(glue, this.database, mode, query);
      staged.push(poses(0, WARM_UP));
      // Where the clock is too coarse for a stage, only their sum over many frames says anything.
      const stageBatch = this.resolution > FINE_CLOCK_MS ? FRAMES : 1;
      for (let frame = WARM_UP; frame < end; frame += stageBatch) {
        const next = Math.min(frame + stageBatch, end);
        const costs = staged.pushTimed(poses(frame, next));
        names.forEach((name, i) => {
          samples.get(name)!.push(costs[i]! / (next - frame));
        });
      }
      staged.free();

      for (let frame = 0; frame < end; frame += COLD_STRIDE) {
        const cold = stylizerFor(glue, this.database, mode, query);
        samples.get("cold search")!.push(cold.pushTimed(poses(frame, frame + 1))[names.indexOf("search")]!);
        cold.free();
      }
    }
    for (const [stage, times] of samples) this.add(stage, mode, times);
  }

  /** Memory with one and with three target styles selected; it never shrinks, so this comes last. */
  measureMemory(): void {
    const { glue, memory } = this.instance;
    const megabytes = () => memory.buffer.byteLength / 1e6;
    const one_style_mb = megabytes();
    const stylizer = new glue.Stylizer(this.database);
    const styles = this.database.styles().length;
    stylizer.setStyles(Float32Array.from({ length: styles }, (_, style) => (style < 3 ? 1 / 3 : 0)));
    stylizer.push(this.workload.queries[0]!.poses.subarray(0, POSE_FLOATS));
    this.report.memory.push({ engine: this.engine, one_style_mb, three_styles_mb: megabytes() });
    stylizer.free();
  }

  free(): void {
    this.database.free();
  }

  private add(stage: string, mode: Mode, samples: number[]): void {
    const { engine, classes } = this;
    this.report.rows.push({ stage, mode, engine, frames: this.database.frames(), classes, ...summarise(samples) });
  }
}
