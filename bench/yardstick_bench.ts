/**
 * Timing of a reference implementation, and comparison of its results with the engine's, without which the times would
 * be meaningless.
 *
 * It searches, regresses, and finds durations and contacts. The engine's frame also contains features, blending and
 * feet, so the ratios are underestimates.
 */
import { clockResolution, timedOften } from "./clock";
import { LEAST_WEIGHT, stylizerFor, WARM_UP } from "./engine_bench";
import type { Database, Instance, Yardstick } from "./engines";
import { type Agreement, type Mode, type Report, summarise } from "./report";
import { POSE_FLOATS, type Query } from "./workload";

/** Number of frames of every query that a reference implementation processes, and the distance between them. */
const FRAMES = 4;
const STRIDE = 20;
/** Numbers of a row of degrees of freedom, of its angles and height, and of a frame of positions. */
const ROW = 68;
const ANGLES_AND_HEIGHT = 64;
const POSITIONS = 63;
const WINDOW = 5;
/** Rounding of a squared distance, m²: its terms are of the order of 1 m². */
const ROUNDING = 2e-5;
/**
 * Greatest effect of rounding on an angle, radians, or a height, metres. JavaScript computes in double precision;
 * simple loops in single precision lose accuracy of distances on long paths.
 */
const TOLERANCE = { "wasm-naive": 5e-3, "js-naive": 1e-3 };
/** Greatest effect of rounding, and of the engine's 16-bit rows, on a duration, seconds … */
const DURATION_TOLERANCE = 5e-5;
/** … and on a probability: other neighbours that are as near as the last may vote. */
const CONTACT_TOLERANCE = 0.02;

/** A reference implementation, and an engine with the workload's database open. */
export class YardstickBench {
  private readonly classes: Uint32Array;
  private readonly resolution = clockResolution();
  private readonly found = new Map<Mode, { times: Times; agreement: Agreement }>();

  constructor(
    private readonly yardstick: Yardstick,
    private readonly engine: keyof typeof TOLERANCE,
    private readonly instance: Instance,
    private readonly database: Database,
    private readonly report: Report,
  ) {
    this.classes = database.classes();
  }

  /** Measures a query. Throws if the results differ from the engine's. */
  measure(mode: Mode, query: Query): void {
    const { times, agreement } = this.found.get(mode) ?? {
      agreement: {
        engine: this.engine,
        mode,
        neighbour_sets: 0,
        identical: 0,
        tied: 0,
        largest_difference: 0,
        largest_duration_difference_ms: 0,
        largest_contact_difference: 0,
      },
      times: { frame: [], search: [], regression: [], timing: [], contact: [] },
    };
    this.found.set(mode, { times, agreement });
    this.follow(query, mode, times, agreement);
    const within =
      agreement.largest_difference < TOLERANCE[this.engine] &&
      agreement.largest_duration_difference_ms < 1e3 * DURATION_TOLERANCE &&
      agreement.largest_contact_difference < CONTACT_TOLERANCE;
    if (agreement.identical + agreement.tied < agreement.neighbour_sets || !within)
      throw new Error(`The yardstick computes something else than the engine: ${JSON.stringify(agreement)}`);
  }

  /** Adds the measurements to the report. */
  finish(): void {
    const { engine, database, report } = this;
    const [frames, classes] = [database.frames(), this.classes.length / 3];
    for (const [mode, { times, agreement }] of this.found) {
      for (const [stage, samples] of Object.entries(times))
        report.rows.push({ stage, mode, engine, frames, classes, ...summarise(samples) });
      report.agreement.push(agreement);
    }
  }

  /** Makes the engine style a query, and the reference implementation compute some of its frames. */
  private follow(query: Query, mode: Mode, times: Times, agreement: Agreement): void {
    const { yardstick, database, resolution } = this;
    const { glue } = this.instance;
    const [from, to] = mode === "labelled" ? rangeOf(this.classes, query) : [0, this.classes.length / 3];
    const rows = glue.rowsOf(database, query.poses);
    const positions = glue.positionsOf(database, query.poses);
    const row = (frame: number) => rows.subarray(frame * ROW, (frame + 1) * ROW);
    const reference = stylizerFor(glue, database, mode, query);
    reference.leaveTempo();
    const last = Math.min(WARM_UP + (FRAMES - 1) * STRIDE, query.frames - 1);
    let before: Float32Array = new Float32Array();
    for (let frame = 0; frame <= last; frame++) {
      reference.push(query.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS));
      const expected = reference.predicted(database.neutral());
      if (frame >= WARM_UP && (frame - WARM_UP) % STRIDE === 0) {
        const window = positions.subarray((frame + 1 - WINDOW) * POSITIONS, (frame + 1) * POSITIONS);
        let found: Float32Array = new Float32Array();
        const search = timedOften(() => yardstick.search(window, from, to), resolution);
        const regression = timedOften(() => {
          found = yardstick.predict(row(frame), row(frame - 1), before, LEAST_WEIGHT[mode]);
        }, resolution);
        let [step, votes]: [number, ArrayLike<number>] = [0, []];
        const timing = timedOften(() => {
          step = yardstick.duration(row(frame), row(frame - 1), found, before);
        }, resolution);
        const contact = timedOften(() => {
          votes = yardstick.contacts(window);
        }, resolution);
        times.search.push(search);
        times.regression.push(regression);
        times.timing.push(timing);
        times.contact.push(contact);
        times.frame.push(search + regression + timing + contact);
        const [expectedStep, ...expectedVotes] = reference.stepAndContacts();
        agreement.largest_duration_difference_ms = Math.max(
          agreement.largest_duration_difference_ms,
          1e3 * Math.abs(step - expectedStep!),
        );
        for (const [side, vote] of expectedVotes.entries())
          agreement.largest_contact_difference = Math.max(
            agreement.largest_contact_difference,
            Math.abs(votes[side]! - vote),
          );

        const recent = query.poses.subarray((frame + 1 - WINDOW) * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
        for (let label = from; label < to; label++) {
          const neighbours = yardstick.neighbours(label);
          const wanted = new Set(reference.neighboursIn(label, neighbours.length, recent));
          compareSets(agreement, neighbours, yardstick.distances(label), wanted);
        }
        for (let d = 0; d < ANGLES_AND_HEIGHT; d++) {
          const difference = Math.abs(found[d]! - expected[d]!);
          agreement.largest_difference = Math.max(agreement.largest_difference, difference);
        }
      }
      before = expected;
    }
    reference.free();
  }
}

/** Milliseconds by stage. */
type Times = Record<"frame" | "search" | "regression" | "timing" | "contact", number[]>;

/** Counts a set of neighbours as equal to the engine's, as different only by rounding, or as different. */
function compareSets(
  agreement: Agreement,
  rows: ArrayLike<number>,
  distances: ArrayLike<number>,
  wanted: ReadonlySet<number>,
): void {
  const farthest = distances[distances.length - 1]!;
  const strangers = Array.from(rows, (row, n) => ({ row, distance: distances[n]! })).filter((n) => !wanted.has(n.row));
  agreement.neighbour_sets++;
  if (wanted.size === rows.length && strangers.length === 0) agreement.identical++;
  else if (wanted.size === rows.length && strangers.every((n) => n.distance >= farthest - ROUNDING)) agreement.tied++;
}

/** The class of a query as a range of classes. */
function rangeOf(table: Uint32Array, { action, style }: Query): [number, number] {
  for (let label = 0; label < table.length / 3; label++)
    if (table[3 * label] === action && table[3 * label + 1] === style) return [label, label + 1];
  throw new Error(`The database has no class of action ${action} and style ${style}.`);
}
