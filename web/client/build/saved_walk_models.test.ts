import { beforeEach, expect, test } from "vitest";
import { type Failures, fakeIndexedDb } from "../../../tests/fake_indexed_db";
import type { TrainedWalk } from "./protocol";
import { MAX_MODELS, trainedOnce } from "./saved_walk_models";

let failures: Failures;
let clock = 0;
let trained: number[];
beforeEach(() => {
  failures = {};
  fakeIndexedDb(failures);
  clock = 0;
  trained = [];
});

/** The model for a database of one byte, from the module with a hash in its name. */
function model(database: number, module = "https://strut.example/assets/build-0123abcd.wasm"): Promise<TrainedWalk> {
  const train = async () => {
    trained.push(database);
    return { file: Uint8Array.of(database), styles: [], clips: 1, refused: [] };
  };
  return trainedOnce(new URL(module), Uint8Array.of(database), train, ++clock);
}

test("a database is trained once by a module, and again by another", async () => {
  expect((await model(7)).file).toEqual(Uint8Array.of(7));
  expect((await model(7)).file).toEqual(Uint8Array.of(7));
  expect(trained).toEqual([7]);
  await model(7, "https://strut.example/assets/build-9999zzzz.wasm");
  await model(7, "https://strut.example/assets/build.wasm");
  expect(trained, "a module without a hash may be any").toEqual([7, 7, 7]);
});

test("of many models those that were used last are kept", async () => {
  for (let database = 0; database < MAX_MODELS; database++) await model(database);
  await model(0);
  await model(MAX_MODELS);
  trained = [];
  for (let database = 2; database < MAX_MODELS; database++) await model(database);
  await model(0);
  await model(MAX_MODELS);
  expect(trained).toEqual([]);
  await model(1);
  expect(trained, "the one that was not used for the longest time is gone").toEqual([1]);
});

test("where the browser has no room, or keeps nothing, models are trained every time", async () => {
  failures.full = true;
  expect((await model(7)).file).toEqual(Uint8Array.of(7));
  failures.full = false;
  failures.refused = true;
  expect((await model(7)).file).toEqual(Uint8Array.of(7));
  expect(trained).toEqual([7, 7]);
});
