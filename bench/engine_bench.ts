/** Timing of the engine. */
import { batchFor, clockResolution, timed } from "./clock";
import type { Database, Glue, Instance, Stylizer } from "./engines";
import { evenStyles, measureMemory, STYLES } from "./memory";
import { type EngineName, type Mode, type Report, summarise } from "./report";
import { POSE_FLOATS, type Query, type Workload } from "./workload";

/** Number of measured frames of each query, and of unmeasured frames before them. */
const FRAMES = 80;
export const WARM_UP = 20;
/** Number of frames between two cold starts of the search. */
const COLD_STRIDE = 20;
/** A clock with this resolution can measure every stage of a frame. */
const FINE_CLOCK_MS = 0.001;
/** Number of times that a database is opened. */
const OPENINGS = 3;

/** Stage of a frame with several target styles. */
const STYLED_FRAME = `frame, ${STYLES} styles`;

/** Least weight of a class in use, relative to the largest. */
export const LEAST_WEIGHT: Record<Mode, number> = { labelled: 2e-5, unlabelled: 2e-5, all: 0 };

/** Returns a stylizer for a query. The target is the neutral style; the choice does not matter. */
export function stylizerFor(glue: Glue, database: Database, mode: Mode, query: Query): Stylizer {
  const stylizer = new glue.Stylizer(database);
  setMode(stylizer, mode, query);
  return stylizer;
}

/** Sets the known labels of a query. If they change, the next search starts cold. */
function setMode(stylizer: Stylizer, mode: Mode, query: Query): void {
  const [action, style] = mode === "labelled" ? [query.action, query.style] : [-1, -1];
  stylizer.setClasses(action, style, LEAST_WEIGHT[mode]);
}

/** One build of the engine with the workload's database open. */
export class EngineBench {
  private readonly database: Database;
  private readonly classes: number;
  private readonly resolution = clockResolution();
  private readonly samples = new Map<Mode, Map<string, number[]>>();

  /** Opens the database and measures the time and the memory. */
  constructor(
    private readonly instance: Instance,
    private readonly engine: EngineName,
    workload: Workload,
    private readonly report: Report,
  ) {
    const { glue } = instance;
    // Making the workload took more memory than styling does.
    instance.restart();
    const openings: number[] = [];
    const open = () => {
      let opened: Database | undefined;
      openings.push(
        timed(() => {
          opened = glue.Database.fromBytes(workload.bytes);
        }),
      );
      return opened!;
    };
    const first = open();
    this.classes = first.classes().length / 3;
    report.memory.push(measureMemory(instance, engine, first, workload.queries));
    first.free();
    for (let i = 2; i < OPENINGS; i++) open().free();
    this.database = open();
    this.add("open", "all", openings);
  }

  /**
   * Styles a query: once for the whole frames, once with the times of each stage, and at some frames from a cold start.
   */
  measure(mode: Mode, query: Query): void {
    const { glue } = this.instance;
    const names = glue.stageNames();
    const all = this.samples.get(mode) ?? new Map<string, number[]>();
    this.samples.set(mode, all);
    const add = (stage: string, ms: number) => {
      const times = all.get(stage);
      if (times) times.push(ms);
      else all.set(stage, [ms]);
    };
    const poses = (from: number, to: number) => query.poses.subarray(from * POSE_FLOATS, to * POSE_FLOATS);
    const end = Math.min(query.frames, WARM_UP + FRAMES);
    const wholeFrames = (stage: string, stylizer: Stylizer) => {
      const warm = timed(() => stylizer.push(poses(0, WARM_UP)));
      const batch = batchFor(warm / WARM_UP, this.resolution);
      for (let frame = WARM_UP; frame < end; frame += batch) {
        const next = Math.min(frame + batch, end);
        add(stage, timed(() => stylizer.push(poses(frame, next))) / (next - frame));
      }
      stylizer.free();
    };
    wholeFrames("frame", stylizerFor(glue, this.database, mode, query));
    const styled = stylizerFor(glue, this.database, mode, query);
    styled.setStyles(evenStyles(this.database));
    wholeFrames(STYLED_FRAME, styled);

    const staged = stylizerFor(glue, this.database, mode, query);
    staged.push(poses(0, WARM_UP));
    // If the clock is too coarse for a stage, only its sum over many frames is meaningful.
    const stageBatch = this.resolution > FINE_CLOCK_MS ? FRAMES : 1;
    for (let frame = WARM_UP; frame < end; frame += stageBatch) {
      const next = Math.min(frame + stageBatch, end);
      const costs = staged.pushTimed(poses(frame, next));
      names.forEach((name, i) => {
        add(name, costs[i]! / (next - frame));
      });
    }
    staged.free();

    const search = names.indexOf("search");
    for (let frame = WARM_UP; frame < end; frame += COLD_STRIDE) {
      const cold = stylizerFor(glue, this.database, mode === "labelled" ? "unlabelled" : "labelled", query);
      cold.push(poses(frame - WARM_UP, frame));
      setMode(cold, mode, query);
      add("cold search", cold.pushTimed(poses(frame, frame + 1))[search]!);
      cold.free();
      const first = stylizerFor(glue, this.database, mode, query);
      add("first search", first.pushTimed(poses(frame, frame + 1))[search]!);
      first.free();
    }
  }

  /** Adds the measurements to the report. */
  finish(): void {
    for (const [mode, samples] of this.samples) for (const [stage, times] of samples) this.add(stage, mode, times);
    this.database.free();
  }

  private add(stage: string, mode: Mode, samples: number[]): void {
    const { engine, classes } = this;
    this.report.rows.push({ stage, mode, engine, frames: this.database.frames(), classes, ...summarise(samples) });
  }
}
