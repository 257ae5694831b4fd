import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { type InputInfo, StrutError } from "../../../client/protocol";
import { DEFAULT_PROPORTIONS, restPose } from "../../../humanoid";
import { initialState } from "../../state/state";
import { ColumnMotions } from "./column_motions";
import { type ColumnName, type MotionRequest, motionRequest } from "./columns";
import type { ColumnMotion } from "./figures";

const MOTION: ColumnMotion = {
  poses: restPose(),
  timeOut: Float32Array.of(0),
  planted: Uint8Array.of(1, 1),
  frameMs: 1,
};
const failure = (code: "fault" | "cancelled" | "bad-input") =>
  new StrutError({ code, message: "It failed.", hint: "" });

/** Requested motions of columns, in order, with their pending answers. */
let asked: ColumnName[];
let answers: { resolve(motion: ColumnMotion | undefined): void; reject(error: unknown): void }[];
let cancelled: number;
let errors: unknown[];
let motions: ColumnMotions;
let of: { input: InputInfo; proportions: ArrayLike<number> };
beforeEach(() => {
  vi.useFakeTimers();
  [asked, answers, errors, cancelled] = [[], [], [], 0];
  of = { input: {} as InputInfo, proportions: DEFAULT_PROPORTIONS };
  motions = new ColumnMotions({
    make: ({ column }) => {
      asked.push(column);
      return new Promise((resolve, reject) => answers.push({ resolve, reject }));
    },
    cancel: () => {
      cancelled += 1;
      answers.at(-1)!.reject(failure("cancelled"));
    },
    onMade: () => {},
    onError: (error) => errors.push(error),
  });
});
afterEach(() => vi.useRealTimers());

const state = (style = "old") => ({ ...initialState(), styles: [{ name: style, weight: 1 }] });
const requests = (columns: readonly ColumnName[], style?: string): MotionRequest[] =>
  columns.flatMap((column) => motionRequest(column, state(style), "neutral") ?? []);
const settle = () => vi.advanceTimersByTimeAsync(200);
/** Answers the last request. */
async function answer(): Promise<void> {
  answers.at(-1)!.resolve(MOTION);
  await settle();
}

test("each motion is asked for once, however often the same is requested: playing and scrubbing restart nothing", async () => {
  motions.request(of, requests(["input", "lar", "mar"]));
  for (let change = 0; change < 40; change++) {
    await vi.advanceTimersByTimeAsync(16);
    motions.request(of, requests(["input", "lar", "mar"]));
  }
  expect([asked, cancelled]).toEqual([["lar"], 0]);
  await answer();
  await answer();
  for (let change = 0; change < 40; change++) {
    await vi.advanceTimersByTimeAsync(16);
    motions.request(of, requests(["input", "lar", "mar"]));
  }
  expect([asked, cancelled]).toEqual([["lar", "mar"], 0]);
  for (const { key } of requests(["lar", "mar"])) expect(motions.get(key)?.frames).toBe(1);
});

test("another style is asked for once it has settled, and what nobody needs any more is cancelled", async () => {
  motions.request(of, requests(["lar"]));
  await settle();
  for (const style of ["proud", "angry", "sexy"]) motions.request(of, requests(["lar"], style));
  expect([asked, cancelled]).toEqual([["lar"], 1]);
  await settle();
  await answer();
  expect(asked).toEqual(["lar", "lar"]);
  expect(motions.get(requests(["lar"], "sexy")[0]!.key)).toBeDefined();
  expect(errors, "a cancellation is no error").toEqual([]);
});

test("a column that is added leaves the others as they are, and what no column shows is forgotten", async () => {
  motions.request(of, requests(["lar"]));
  await settle();
  motions.request(of, requests(["lar", "knn"]));
  await settle();
  await answer();
  await answer();
  expect([asked, cancelled]).toEqual([["lar", "knn"], 0]);
  motions.request(of, requests(["knn"]));
  await settle();
  expect(motions.get(requests(["lar"])[0]!.key)).toBeUndefined();
  motions.request({ ...of, input: {} as InputInfo }, requests(["knn"]));
  await settle();
  expect(asked, "another input has other motions").toEqual(["lar", "knn", "knn"]);
});

test("after a fault it is asked once more; what fails keeps no other column waiting, and is told once", async () => {
  motions.request(of, requests(["lar", "knn"]));
  await settle();
  answers.at(-1)!.reject(failure("fault"));
  await settle();
  answers.at(-1)!.reject(failure("fault"));
  await settle();
  expect(errors).toHaveLength(1);
  await answer();
  motions.request(of, requests(["lar", "knn"]));
  await settle();
  expect(asked).toEqual(["lar", "lar", "knn"]);
  motions.pause();
  motions.resume();
  await settle();
  expect(asked.at(-1), "when the view is shown again").toBe("lar");
});

test("where there is no motion that is known, and nothing is made while the view is hidden", async () => {
  const [real] = requests(["real"]);
  motions.request(of, [real!]);
  expect(motions.isMissing(real!.key)).toBe(false);
  await settle();
  answers.at(-1)!.resolve(undefined);
  await settle();
  expect(motions.isMissing(real!.key)).toBe(true);
  motions.request(of, requests(["lar"]));
  motions.pause();
  await settle();
  expect(asked).toEqual(["real"]);
  motions.resume();
  await settle();
  motions.pause();
  expect(cancelled).toBe(1);
  await settle();
  expect(asked).toEqual(["real", "lar"]);
});
