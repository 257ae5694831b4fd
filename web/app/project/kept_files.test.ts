import { beforeEach, describe, expect, it } from "vitest";
import { fakeIndexedDb } from "../../../tests/fake_indexed_db";
import { dropFile, dropOld, filesOf, KEPT_MS, keepFile } from "./kept_files";

const motion = (name: string) => ({ kind: "motion" as const, name, file: new Blob([name]) });
const namesOf = async (session: string) => (await filesOf(session)).map(({ kind, name }) => `${kind} ${name}`);

beforeEach(() => fakeIndexedDb());

describe("the files of a tab", () => {
  it("are there in the order in which they were dropped, and not in other tabs", async () => {
    await keepFile("one", motion("walk"), 1);
    await keepFile("one", motion("run"), 2);
    await keepFile("one", { kind: "database", name: "walk", file: new Blob(), named: true }, 3);
    await keepFile("two", motion("jump"), 4);
    expect(await namesOf("one")).toEqual(["motion walk", "motion run", "database walk"]);
    expect(await (await filesOf("two"))[0]!.file.text()).toBe("jump");
  });

  it("take the place of others of their name, and are dropped one by one", async () => {
    await keepFile("one", motion("walk"));
    await keepFile("one", { ...motion("walk"), reading: "up~z" });
    expect((await filesOf("one")).map(({ reading }) => reading)).toEqual(["up~z"]);
    await dropFile("one", motion("walk"));
    await dropFile("one", motion("never"));
    expect(await namesOf("one")).toEqual([]);
  });

  it("are deleted a week after their tab was last opened, from another tab", async () => {
    await keepFile("old", motion("walk"), 0);
    await keepFile("new", motion("run"), KEPT_MS);
    await keepFile("mine", motion("jump"), 0);
    await dropOld("mine", KEPT_MS + 1);
    expect([await namesOf("old"), await namesOf("new"), await namesOf("mine")]).toEqual([
      [],
      ["motion run"],
      ["motion jump"],
    ]);
  });

  it("are refused where the browser keeps nothing, or has no room", async () => {
    fakeIndexedDb({ refused: true });
    await expect(keepFile("one", motion("walk"))).rejects.toThrow();
    const failures = { full: false };
    fakeIndexedDb(failures);
    await keepFile("one", motion("walk"));
    failures.full = true;
    await expect(keepFile("one", motion("run"))).rejects.toMatchObject({ name: "QuotaExceededError" });
    expect(await namesOf("one")).toEqual(["motion walk"]);
  });
});
