import { expect, test } from "vitest";
import { type CallOptions, type InputInfo, type SearchFigures, StrutError } from "../../../client/protocol";
import { SearchMeasurement, type SearchRequest } from "./search_measurement";

const FIGURES: SearchFigures = { recall: 0.9, exactMs: 0.2, treesMs: 0.4 };
const request: SearchRequest = { input: {} as InputInfo, neighbours: 40, candidates: 160 };

/** A measurement whose meter answers on the test's request. */
function measured() {
  const calls: { call: CallOptions; resolve(figures: SearchFigures): void; reject(error: unknown): void }[] = [];
  const errors: unknown[] = [];
  const measurement = new SearchMeasurement({
    measure: (_, call) => new Promise((resolve, reject) => calls.push({ call, resolve, reject })),
    onChange: () => {},
    onError: (error) => errors.push(error),
  });
  return { measurement, calls, errors };
}

/** Lets an answer arrive. */
const arrived = () => new Promise((resolve) => setTimeout(resolve));

test("a request is measured once, however often it is made", async () => {
  const { measurement, calls } = measured();
  measurement.request(request);
  measurement.request({ ...request });
  calls[0]!.call.onProgress!({ label: "", fraction: 0.5 });
  expect([measurement.fraction, measurement.figures]).toEqual([0.5, undefined]);
  calls[0]!.resolve(FIGURES);
  await arrived();
  measurement.stop();
  measurement.request(request);
  expect(measurement.figures).toBe(FIGURES);
  expect(calls).toHaveLength(1);
});

test("another request takes the place of the one before, whose figures come too late", async () => {
  const { measurement, calls } = measured();
  measurement.request(request);
  measurement.request({ ...request, candidates: 40 });
  expect(calls[0]!.call.signal!.aborted).toBe(true);
  calls[0]!.resolve(FIGURES);
  await arrived();
  expect(measurement.figures).toBeUndefined();
  measurement.request(undefined);
  expect(calls[1]!.call.signal!.aborted).toBe(true);
});

test("what failed or was stopped is measured again when it is requested again", async () => {
  const { measurement, calls, errors } = measured();
  measurement.request(request);
  calls[0]!.reject(new StrutError({ code: "fault", message: "The engine failed.", hint: "" }));
  await arrived();
  expect(errors).toHaveLength(1);
  measurement.request(request);
  measurement.stop();
  measurement.request(request);
  expect(calls).toHaveLength(3);
});
