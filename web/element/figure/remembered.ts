/** Answers of an engine, computed once. */
import type { LearnEngine } from "../../client/learn/protocol";

/** So many answers of each kind are kept: a drag asks for a new one with every move. */
const KEPT = 64;

/** Remembers the last answers by the engine and what was asked; what failed is asked again. */
export function remembered<Asked extends readonly unknown[], Answer>(
  ask: (engine: LearnEngine, ...asked: Asked) => Promise<Answer>,
): (engine: LearnEngine, ...asked: Asked) => Promise<Answer> {
  const engines = new WeakMap<LearnEngine, Map<string, Promise<Answer>>>();
  return (engine, ...asked) => {
    const known = engines.get(engine) ?? new Map<string, Promise<Answer>>();
    engines.set(engine, known);
    const key = JSON.stringify(asked);
    const answer = known.get(key) ?? ask(engine, ...asked);
    // The last asked for is the last to be forgotten.
    known.delete(key);
    known.set(key, answer);
    if (known.size > KEPT) known.delete(known.keys().next().value!);
    answer.catch(() => known.delete(key));
    return answer;
  };
}
