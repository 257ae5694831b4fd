import { describe, expect, it } from "vitest";
import type { DatabaseInfo, DatabaseSource } from "../../client/protocol";
import type { Outcome, Session } from "../../player/session";
import { initialState } from "../state/state";
import { Store } from "../state/store";
import type { Toasts } from "../ui/toasts";
import { Databases } from "./databases";

/** A fake session that opens every database except those with the given names. */
class FakeSession {
  database: DatabaseInfo | undefined;
  databaseSource: DatabaseSource | undefined;
  inputName = "walk";
  opened: string[] = [];
  /** Settles when the file is read. */
  reading: Promise<unknown> = Promise.resolve();
  /** Settles when the input is open on the displayed database. */
  openingInput: Promise<unknown> = Promise.resolve();

  constructor(readonly broken: readonly string[]) {}

  async openDatabase(source: DatabaseSource): Promise<Outcome> {
    const name = source.kind === "demo" ? `built in${source.set ? `: ${source.set}` : ""}` : source.name;
    await this.reading;
    if (this.broken.includes(name)) return "failed";
    this.opened.push(name);
    this.database = { styles: ["old"], frames: 9 } as unknown as DatabaseInfo;
    this.databaseSource = source;
    await this.openingInput;
    return "done";
  }

  async exchangeDatabase(source: DatabaseSource, signal: AbortSignal): Promise<Outcome> {
    await new Promise((resolve) => setTimeout(resolve, 5));
    if (signal.aborted) return "cancelled";
    this.opened.push("built in beside it");
    this.databaseSource = source;
    return "done";
  }
}

function made(database: string, { broken = [] as string[], kept = ["mine", "bad"] } = {}) {
  const store = new Store({ ...initialState(), database });
  const session = new FakeSession(broken);
  const said: string[] = [];
  const toasts = { note: (text: string) => said.push(text), error: (text: string) => said.push(text) };
  const databases = new Databases(store, toasts as unknown as Toasts, session as unknown as Session, async (name) =>
    kept.includes(name) ? new Blob([name]) : undefined,
  );
  return { store, session, databases, said };
}

describe("the start with a few strides", () => {
  it("opens all motions beside them, which then count as the built-in database", async () => {
    const { store, session, databases } = made("");
    await databases.startWithFirst();
    expect(session.opened).toEqual(["built in: first"]);
    expect(await databases.complete).toBe("done");
    expect(session.opened).toEqual(["built in: first", "built in beside it"]);
    expect([databases.moving, databases.file.name, store.state.database]).toEqual([false, "", ""]);
  });

  it("does not come to all motions where another database is opened meanwhile", async () => {
    const { session, databases } = made("");
    await databases.startWithFirst();
    await databases.open({ kind: "strutdb", name: "mine", file: new Blob() }, "mine");
    expect(await databases.complete).toBe("cancelled");
    expect(session.opened).toEqual(["built in: first", "mine"]);
  });
});

describe("a database that was built", () => {
  it("is opened, and keeps the renamed styles chosen where it replaces the open one", async () => {
    const { session, databases } = made("mine");
    await databases.follow("");
    const file = new Blob(["new"]);
    const renamed = new Map([["old", "ancient"]]);
    const known = async (name: string) => {
      const opening = databases.openBuilt({ name, file }, true, renamed);
      const { size } = databases.renamed;
      expect(await opening).toBe(true);
      return size;
    };
    expect([await known("mine"), await known("other")]).toEqual([1, 0]);
    expect(databases.renamed.size, "afterwards").toBe(0);
    expect(session.opened).toEqual(["mine", "mine", "other"]);
    expect(databases.file).toEqual({ name: "other", file });
  });
});

describe("the database of a link", () => {
  it("is opened where it is kept here", async () => {
    const { store, session, databases } = made("mine");
    await databases.follow("");
    expect(session.opened).toEqual(["mine"]);
    expect([store.state.database, databases.moving, databases.file.name]).toEqual(["mine", false, "mine"]);
  });

  it("gives way to the built-in one, with a sentence, where it cannot be opened", async () => {
    const { store, session, databases, said } = made("bad", { broken: ["bad"] });
    await databases.follow("");
    expect(session.opened).toEqual(["built in"]);
    expect([store.state.database, databases.moving]).toEqual(["", false]);
    expect(said.join()).toContain("“bad” could not be opened");
  });

  it("gives way to the built-in one where it is not here", async () => {
    const { store, session, databases, said } = made("gone");
    await databases.follow("");
    expect([session.opened, store.state.database]).toEqual([["built in"], ""]);
    expect(said.join()).toContain("“gone”");
  });

  it("leaves the one that was open, and the state says so", async () => {
    const { store, session, databases } = made("mine", { broken: ["bad"] });
    await databases.follow("");
    store.edit({ database: "bad" });
    await databases.follow("");
    expect([session.opened, store.state.database]).toEqual([["mine"], "mine"]);
    expect(databases.file.name).toBe("mine");
  });

  it("counts only where nothing else was asked for meanwhile", async () => {
    const { store, session, databases } = made("mine");
    const first = databases.follow("");
    store.edit({ database: "" });
    await databases.follow("");
    await first;
    expect([session.opened.at(-1), store.state.database]).toEqual(["built in", ""]);
  });

  it("is opened again where another one, which is still being opened, was asked for and is no longer", async () => {
    const { store, session, databases } = made("mine");
    await databases.follow("");
    store.edit({ database: "" });
    const undone = databases.follow("");
    store.edit({ database: "mine" });
    expect([databases.moving, databases.mustFollow]).toEqual([true, true]);
    await Promise.all([undone, databases.follow("")]);
    expect([session.opened.at(-1), store.state.database, databases.moving]).toEqual(["mine", "mine", false]);
  });
});

describe("a database that a person opens", () => {
  it("does not come after what is asked for while it is being opened, be that the one that is open", async () => {
    const { store, session, databases } = made("mine");
    await databases.follow("");
    const dropped = databases.open({ kind: "strutdb", name: "dropped", file: new Blob() }, "");
    expect([databases.mustFollow, store.state.database]).toEqual([true, "mine"]);
    await databases.follow("");
    expect(await dropped).toBe(false);
    expect([session.opened.at(-1), store.state.database, databases.file.name]).toEqual(["mine", "mine", "mine"]);
    expect(databases.mustFollow).toBe(false);
  });

  it("stays where a link that names none comes while it is shown and its input is still being opened", async () => {
    const { store, session, databases } = made("");
    await databases.follow("");
    let opened = () => {};
    session.openingInput = new Promise<void>((resolve) => {
      opened = resolve;
    });
    const dropped = databases.open({ kind: "strutdb", name: "dropped", file: new Blob() }, "");
    expect(databases.mustFollow).toBe(true);
    await session.reading;
    expect([session.opened.at(-1), databases.mustFollow]).toEqual(["dropped", false]);
    store.edit({ database: "mine" });
    expect(databases.mustFollow).toBe(true);
    store.edit({ database: "" });
    opened();
    expect([await dropped, databases.mustFollow, databases.file.name]).toEqual([true, false, "dropped"]);
  });

  it("enters the state once it is open, and not before", async () => {
    const { store, databases } = made("", { broken: ["bad"] });
    await databases.follow("");
    expect(await databases.open({ kind: "strutdb", name: "bad", file: new Blob() }, "bad")).toBe(false);
    expect(store.state.database).toBe("");
    expect(await databases.open({ kind: "strutdb", name: "mine", file: new Blob() }, "mine")).toBe(true);
    expect([store.state.database, store.state.view]).toEqual(["mine", "play"]);
  });
});

describe("a database of a project", () => {
  it("has a name that no other has, and is followed by it", async () => {
    const { store, session, databases } = made("");
    const file = new Blob(["project"]);
    expect(await databases.hold("mine.strutdb", file)).toBe("mine (2)");
    expect(await databases.hold("mine", file)).toBe("mine (2)");
    expect(await databases.hold("mine", new Blob())).toBe("mine (3)");
    expect(await databases.hold("other.strutdb", new Blob())).toBe("other");
    await databases.follow("");
    store.edit({ database: "mine (2)" });
    await databases.follow("");
    expect([session.opened.at(-1), databases.file]).toEqual(["mine (2)", { name: "mine (2)", file }]);
    databases.release("other");
    expect([...databases.held.keys()]).toEqual(["mine (2)", "mine (3)"]);
  });

  it("that has no name is opened where none is asked for", async () => {
    const { session, databases } = made("");
    expect(databases.unnamed).toBeUndefined();
    databases.unnamed = { name: "dropped", file: new Blob() };
    await databases.follow("");
    expect([session.opened, databases.unnamed?.name]).toEqual([["dropped"], "dropped"]);
    await databases.open({ kind: "demo" }, "");
    expect(databases.unnamed).toBeUndefined();
  });

  it("can be come back to from the built-in one, once it was given a name", async () => {
    const { store, session, databases } = made("");
    await databases.nameUnnamed();
    expect(databases.held.size).toBe(0);
    const file = new Blob();
    await databases.open({ kind: "strutdb", name: "dropped.strutdb", file }, "");
    await databases.nameUnnamed();
    expect([store.state.database, databases.mustFollow, databases.unnamed]).toEqual(["dropped", false, undefined]);
    store.edit({ database: "" });
    expect(databases.mustFollow).toBe(true);
    await databases.follow("");
    store.edit({ database: "dropped" });
    await databases.follow("");
    expect(session.opened).toEqual(["dropped.strutdb", "built in", "dropped"]);
  });
});
