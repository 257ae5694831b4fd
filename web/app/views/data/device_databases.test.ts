import { beforeEach, describe, expect, test } from "vitest";
import { type Failures, fakeIndexedDb } from "../../../../tests/fake_indexed_db";
import { DeviceDatabases } from "./device_databases";
import { addDatabase, listSavedDatabases, type SavedDatabase } from "./saved_databases";

let failures: Failures;
let databases: DeviceDatabases;
beforeEach(async () => {
  failures = {};
  fakeIndexedDb(failures);
  databases = new DeviceDatabases();
  await databases.load();
});

/** A database identified by its number of frames. */
const database = (name: string, frames: number): SavedDatabase => ({
  name,
  frames,
  file: new Blob([`${frames} frames`]),
  clips: 1,
  actions: ["walk"],
  styles: ["old"],
});
const contents = (all: readonly SavedDatabase[]) => Object.fromEntries(all.map(({ name, frames }) => [name, frames]));
/** What a page that is opened now would find. */
const kept = async () => contents(await listSavedDatabases());

describe("a database", () => {
  test("is never put in the place of another of its name", async () => {
    expect(await databases.add(database("My clips", 1))).toEqual({ name: "My clips", unkept: "" });
    expect(await databases.add(database("My clips", 2))).toEqual({ name: "My clips 2", unkept: "" });
    // Another tab does not know of this one.
    const other = new DeviceDatabases();
    expect((await other.add(database("My clips", 3))).name).toBe("My clips 3");
    expect(await addDatabase(database("My clips", 4))).toBe("My clips 4");
    expect(await kept()).toEqual({ "My clips": 1, "My clips 2": 2, "My clips 3": 3, "My clips 4": 4 });
  });

  test("is replaced where that was asked for", async () => {
    await databases.add(database("walks", 1));
    await databases.replace(database("walks", 2));
    expect(await kept()).toEqual({ walks: 2 });
    expect(contents(databases.all)).toEqual({ walks: 2 });
  });

  test("that was deleted comes back, beside one that has taken its name", async () => {
    await databases.add(database("walks", 1));
    await databases.delete("walks");
    expect(await kept()).toEqual({});
    expect(contents(databases.deleted)).toEqual({ walks: 1 });
    await databases.add(database("walks", 2));
    expect(await databases.restore("walks")).toEqual({ name: "walks 2", unkept: "" });
    expect(await kept()).toEqual({ walks: 2, "walks 2": 1 });
    expect(databases.deleted).toEqual([]);
  });
});

describe("a browser without room", () => {
  beforeEach(async () => {
    await databases.add(database("walks", 1));
    failures.full = true;
  });

  test("leaves a new database where it is until the view is closed, and says so", async () => {
    const { name, unkept } = await databases.add(database("walks", 2));
    expect(name).toBe("walks 2");
    expect(unkept).toMatch(/^The browser has no room left for it\. .*\.$/);
    expect(contents(databases.all)).toEqual({ walks: 1, "walks 2": 2 });
    expect([databases.isKept("walks"), databases.isKept("walks 2"), databases.holdsUnkept]).toEqual([
      true,
      false,
      true,
    ]);
    expect(await kept()).toEqual({ walks: 1 });
  });

  test("keeps what was to be replaced, beside what would have replaced it", async () => {
    const { name, unkept } = await databases.replace(database("walks", 2));
    expect([name, unkept !== ""]).toEqual(["walks 2", true]);
    expect(contents(databases.all)).toEqual({ walks: 1, "walks 2": 2 });
    expect(await kept()).toEqual({ walks: 1 });
  });

  test("deletes what was never kept, and nothing else", async () => {
    const { name } = await databases.add(database("walks", 2));
    await databases.delete(name);
    failures.full = false;
    await databases.load();
    expect(contents(databases.all)).toEqual({ walks: 1 });
  });
});

test("a browser that keeps nothing is said to do so, and what is built can be used", async () => {
  failures.refused = true;
  await databases.load();
  expect(databases.fault).toMatch(/^The browser does not let this page keep files/);
  const { name, unkept } = await databases.add(database("walks", 1));
  expect([name, unkept]).toEqual(["walks", databases.fault]);
  expect(contents(databases.all)).toEqual({ walks: 1 });
});
