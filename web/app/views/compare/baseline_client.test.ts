import { expect, test } from "vitest";
import type { StrutClient } from "../../../client/client";
import { type DatabaseInfo, type DatabaseSource, StrutError } from "../../../client/protocol";
import { BaselineClient, type OpenSources } from "./baseline_client";

const demo: DatabaseSource = { kind: "demo" };
const session: OpenSources = {
  database: { styles: ["neutral", "old"], neutral: "neutral" } as unknown as DatabaseInfo,
  databaseSource: demo,
  inputName: "walk",
  library: { source: () => ({ kind: "built-in", name: "walk" }) as never },
};
const fault = new StrutError({ code: "fault", message: "The engine failed.", hint: "" });

/** A fake engine that, like the real one, has no database and input after it failed twice. */
class FakeEngine {
  open: string[] = [];
  calls: string[] = [];
  faults = 0;
  readonly client = {
    openDatabase: async () => {
      this.calls.push("database");
      this.open = ["database"];
    },
    openInput: async () => {
      this.calls.push("input");
      this.open.push("input");
    },
    style: async () => this.#answer("style"),
    counterpart: async () => this.#answer("counterpart"),
    dispose: () => this.calls.push("dispose"),
  } as unknown as StrutClient;

  async #answer(call: string): Promise<never> {
    this.calls.push(call);
    if (this.faults > 0) {
      this.faults -= 1;
      this.open = [];
      throw fault;
    }
    if (this.open.join() !== "database,input")
      throw new StrutError({ code: "not-open", message: "Nothing is open.", hint: "" });
    return { poses: new Float32Array(), timeOut: new Float32Array(), planted: new Uint8Array() } as never;
  }
}

test("database and input are opened once, and again after the engine has failed", async () => {
  const engine = new FakeEngine();
  const baselines = new BaselineClient(async () => engine.client);
  const ask = () => baselines.style(session, {} as never, {});
  await ask();
  await ask();
  expect(engine.calls).toEqual(["database", "input", "style", "style"]);
  engine.calls = [];
  engine.faults = 2;
  await expect(ask()).rejects.toBe(fault);
  await expect(ask()).rejects.toBe(fault);
  await ask();
  expect(engine.calls).toEqual(["style", "database", "input", "style", "database", "input", "style"]);
  await baselines.counterpart(session, { old: 1 }, {});
  await baselines.counterpart(session, { old: 1 }, {});
  expect(
    engine.calls.filter((call) => call === "counterpart"),
    "what is known is not asked again",
  ).toHaveLength(1);
  baselines.dispose();
  await Promise.resolve();
  expect(engine.calls.at(-1)).toBe("dispose");
});
