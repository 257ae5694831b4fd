/** What the lessons' engine does, call by call. */
import { loadBuiltIn } from "../../engine/built_in";
import { counterpartOf } from "../../engine/compare/wasm";
import { Engine } from "../../engine/engine";
import type { LearnEngine } from "./protocol";

/** The database and its motions, open as long as the worker lives. */
async function open() {
  const [engine, motions] = await Promise.all([Engine.load(), loadBuiltIn()]);
  return { engine, motions, database: engine.openDatabase({ kind: "demo", motions }) };
}

/** The functions behind {@link LearnEngine}. */
export function createLearnTable(): LearnEngine {
  let opening: ReturnType<typeof open> | undefined;
  const opened = () => {
    opening ??= open().catch((error) => {
      opening = undefined;
      throw error;
    });
    return opening;
  };
  return {
    inputs: async () => {
      const { engine, motions } = await opened();
      return engine.inputsOf(motions);
    },
    styles: async () => {
      const { styles, neutral } = (await opened()).database.info;
      return [neutral, ...styles.filter((style) => style !== neutral)];
    },
    motion: async (name) => {
      const { engine, motions, database } = await opened();
      const input = engine.openInput(database, { kind: "built-in", name, motions });
      const { poses, contacts, rateHz } = input.info;
      input.dispose();
      return { poses, contacts, rateHz, proportions: Float32Array.from(database.info.proportions) };
    },
    counterpart: async (input, style) => {
      await opened();
      return counterpartOf(input, style);
    },
  };
}
