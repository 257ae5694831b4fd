/** Requests for models in quick succession; loading finishes when the test says so. */
import { beforeEach, describe, expect, it } from "vitest";
import { ModelLoader } from "./model_loader";

interface Request {
  source: string;
}

class Model {
  disposed = false;
  constructor(readonly source: string) {}
  dispose(): void {
    this.disposed = true;
  }
}

/** Loads in progress, oldest first. */
let loads: { source: string; finish: (model: Model) => void; fail: (error: Error) => void }[];
let cancelled: number;
let ready: Model[];
let failed: string[];
let loader: ModelLoader<Request, Model>;

beforeEach(() => {
  [loads, cancelled, ready, failed] = [[], 0, [], []];
  loader = new ModelLoader<Request, Model>({
    isSame: (a, b) => a.source === b.source,
    load: ({ source }) => new Promise((finish, fail) => loads.push({ source, finish, fail })),
    cancel: () => {
      cancelled += 1;
    },
    onReady: (model) => ready.push(model),
    onFailed: (error) => failed.push((error as Error).message),
  });
});

/** Requests a model; each request is a new object, as in the views. */
const request = (source: string) => loader.request({ source });

async function finish(load: number): Promise<Model> {
  const model = new Model(loads[load]!.source);
  loads[load]!.finish(model);
  await Promise.resolve();
  await Promise.resolve();
  return model;
}

async function open(source: string): Promise<Model> {
  const opening = request(source);
  const model = await finish(loads.length - 1);
  await opening;
  return model;
}

describe("a model loader", () => {
  it("opens what was requested and disposes of the model before", async () => {
    const first = await open("a");
    expect(loader.model).toBe(first);
    const second = await open("b");
    expect(loader.model).toBe(second);
    expect([first.disposed, second.disposed]).toEqual([true, false]);
  });

  it("opens a model that is requested again while it loads, and loads it once", async () => {
    await open("a");
    void request("b");
    void request("b");
    expect(loads.length).toBe(2);
    const model = await finish(1);
    expect(loader.model).toBe(model);
    expect(ready.map(({ source }) => source)).toEqual(["a", "b"]);
  });

  it("opens the last of several requests, in whichever order they finish", async () => {
    void request("a");
    void request("b");
    void request("c");
    const last = await finish(2);
    const stale = [await finish(0), await finish(1)];
    expect(loader.model).toBe(last);
    expect(ready).toEqual([last]);
    expect(stale.map(({ disposed }) => disposed)).toEqual([true, true]);
  });

  it("keeps what is open where a request goes back to it, and drops the other", async () => {
    const first = await open("a");
    void request("b");
    expect(loader.loading).toBe(true);
    await request("a");
    expect([loader.loading, cancelled]).toEqual([false, 1]);
    expect(ready, "the page hears that it is the present one again").toEqual([first, first]);
    const stale = await finish(1);
    expect(loader.model).toBe(first);
    expect([first.disposed, stale.disposed]).toEqual([false, true]);
  });

  it("says nothing where what is open is requested again", async () => {
    await open("a");
    await request("a");
    expect([loads.length, ready.length]).toEqual([1, 1]);
  });

  it("says what failed, and tries it again when it is requested again", async () => {
    const first = await open("a");
    const failing = request("b");
    loads[1]!.fail(new Error("no walks"));
    await failing;
    expect(failed).toEqual(["no walks"]);
    expect([loader.failed, loader.isReady({ source: "a" })]).toEqual([true, false]);
    const again = request("b");
    expect(loader.failed).toBe(false);
    loads[2]!.fail(new Error("no walks"));
    await again;
    await request("a");
    expect(loader.failed).toBe(false);
    expect(ready).toEqual([first, first]);
  });

  it("ignores the failure of a request that is no longer the last", async () => {
    const stale = request("a");
    void request("b");
    loads[0]!.fail(new Error("no walks"));
    await stale;
    expect(failed).toEqual([]);
    expect(loader.loading).toBe(true);
  });

  it("gives up without a word, and disposes of what still arrives", async () => {
    void request("a");
    loader.cancel();
    expect(loader.loading).toBe(false);
    const late = await finish(0);
    expect([late.disposed, ready.length, failed.length]).toEqual([true, 0, 0]);
    expect(loader.model).toBeUndefined();
  });

  it("disposes of everything", async () => {
    const model = await open("a");
    void request("b");
    loader.dispose();
    const late = await finish(1);
    expect([model.disposed, late.disposed]).toEqual([true, true]);
  });
});
