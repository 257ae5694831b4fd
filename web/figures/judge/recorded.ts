/** Results of the methods recorded in `docs/evaluation.md`, read when the page is built. */
import * as record from "../../../docs/evaluation.md";
import { METHODS, type Method, type Source } from "./judge_state";

/** Results of a method; values that were not measured are omitted. */
export interface Achieved {
  /** Mean distance of the joints from those of the performance, mm. */
  pose?: number;
  /** Mean acceleration of the joints, relative to the input's. */
  acceleration: number;
  /** Correlation of the fast content with the input's. */
  content: number;
}

/** Methods and floors of a table. */
export interface Standing {
  methods: ReadonlyMap<Method, Achieved>;
  /** Pose error of the unchanged input, and of the best other take of the target style, mm. */
  unchanged?: number;
  otherTake?: number;
}

type Row = (typeof record.theBuiltInMotions)[number];

/** The results in a table of the document. */
export function standingOf(rows: readonly Row[]): Standing {
  const rowOf = (name: string) => rows.find(({ method }) => method === name);
  const numberOf = (row: Row | undefined, column: string) => {
    const value = row?.[column];
    return typeof value === "number" ? value : undefined;
  };
  const poseOf = (row: Row | undefined) => {
    const cm = numberOf(row, "pose cm");
    return cm === undefined ? undefined : 10 * cm;
  };
  const methods = new Map<Method, Achieved>();
  for (const method of METHODS) {
    const row = rowOf(method);
    const [acceleration, content] = [numberOf(row, "acceleration ×"), numberOf(row, "content")];
    if (acceleration === undefined || content === undefined) continue;
    const pose = poseOf(row);
    methods.set(method, { acceleration, content, ...(pose !== undefined && { pose }) });
  }
  const unchanged = poseOf(rowOf("input unchanged"));
  const otherTake = poseOf(rowOf("floor: best other take"));
  return { methods, ...(unchanged !== undefined && { unchanged }), ...(otherTake !== undefined && { otherTake }) };
}

/** Results on recorded walks inside the database, and on motion of other collections. */
export const RECORDED: Readonly<Record<Exclude<Source, "live">, Standing>> = {
  inside: standingOf(record.oneActionEveryMethod),
  off: standingOf(record.motionThatTheDatabaseDoesNotHoldMethods),
};

/** Error of another take of the style on the built-in motions, mm. */
export const BUILT_IN_OTHER_TAKE = standingOf(record.theBuiltInMotions).otherTake;

/** Minimum content that a method must keep. */
export const CONTENT_LEFT = 0.8;

/** The method whose smoothness is nearest to the input's, among those that keep its content; of equal ones the first. */
export function steadiest({ methods }: Standing): Method | undefined {
  const keeping = [...methods].filter(([, { content }]) => content >= CONTENT_LEFT);
  const off = ([, { acceleration }]: [Method, Achieved]) => Math.abs(acceleration - 1);
  return keeping.sort((a, b) => off(a) - off(b))[0]?.[0];
}
