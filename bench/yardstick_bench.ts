/**
 * A yardstick under a stop-watch, and its results beside the engine's: one that computed something else would be
 * worthless.
 *
 * It searches and regresses, and does nothing else, while the engine's frame also takes features, timing, contacts
 * and feet: ratios are understated.
 */
import { timed } from "./clock";
import { DELTA, stylizerFor, WARM_UP } from "./engine_bench";
import type { Database, Instance, Yardstick } from "./engines";
import { type Agreement, type EngineName, type Mode, type Report, summarise } from "./report";
import { POSE_FLOATS, type Query, type Workload } from "./workload";

/** Frames of every query that a yardstick sees, and the distance between them. */
const FRAMES = 4;
const STRIDE = 20;
/** Numbers of a row of degrees of freedom, of them angles and height, and of a frame of positions. */
const ROW = 68;
const ANGLES_AND_HEIGHT = 64;
const POSITIONS = 63;
const WINDOW = 5;
/** Rounding of a squared distance, m²: its terms are of the order of 1 m². */
const ROUNDING = 2e-5;
/** Most that rounding may change an angle, radians, or a height, metres. */
const TOLERANCE = 1e-3;

/** Measures a yardstick in a mode. Throws if its results are not the engine's. */
export async function measureYardstick(
  yardstick: Yardstick,
  engine: EngineName,
  mode: Mode,
  { glue }: Instance,
  database: Database,
  workload: Workload,
  report: Report,
  turn: () => Promise<void>,
): Promise<void> {
  const table = database.classes();
  const classes = table.length / 3;
  const agreement: Agreement = { engine, mode, neighbour_sets: 0, identical: 0, tied: 0, largest_difference: 0 };
  const times = { frame: [] as number[], search: [] as number[], regression: [] as number[] };
  const target = database.neutral();
  for (const query of workload.queries) {
    await turn();
    const [from, to] = mode === "labelled" ? rangeOf(table, query) : [0, classes];
    const rows = glue.rowsOf(database, query.poses);
    const positions = glue.positionsOf(database, query.poses);
    const row = (frame: number) => rows.subarray(frame * ROW, (frame + 1) * ROW);
    const reference = stylizerFor(glue, database, mode, query);
    const last = Math.min(WARM_UP + (FRAMES - 1) * STRIDE, query.frames - 1);
    let before: Float32Array = new Float32Array();
    for (let frame = 0; frame <= last; frame++) {
      reference.push(query.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS));
      const expected = reference.predicted(target);
      if (frame >= WARM_UP && (frame - WARM_UP) % STRIDE === 0) {
        const window = positions.subarray((frame + 1 - WINDOW) * POSITIONS, (frame + 1) * POSITIONS);
        let found: Float32Array = new Float32Array();
        const search = timed(() => yardstick.search(window, from, to));
        const regression = timed(() => {
          found = yardstick.predict(row(frame), row(frame - 1), before, DELTA[mode]);
        });
        times.search.push(search);
        times.regression.push(regression);
        times.frame.push(search + regression);

        for (let label = from; label < to; label++) {
          const rows = yardstick.neighbours(label);
          const recent = query.poses.subarray((frame + 1 - WINDOW) * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
          const wanted = new Set(reference.neighboursIn(label, rows.length, recent));
          compareSets(agreement, rows, yardstick.distances(label), wanted);
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
  for (const [stage, samples] of Object.entries(times))
    report.rows.push({ stage, mode, engine, frames: database.frames(), classes, ...summarise(samples) });
  report.agreement.push(agreement);
  if (agreement.identical + agreement.tied < agreement.neighbour_sets || !(agreement.largest_difference < TOLERANCE))
    throw new Error(`The yardstick computes something else than the engine: ${JSON.stringify(agreement)}`);
}

/** Counts a set of neighbours as the engine's, as one that differs by rounding alone, or neither. */
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
