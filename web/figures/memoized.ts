/** Memoised answers of an engine. */
import type { LearnEngine } from "../client/learn/protocol";

/** Number of answers of each kind that are kept: a drag requests a new one with every move. */
const KEPT = 64;

/** Memoises the last answers by the engine and the arguments; failed requests are repeated. */
export function memoized<Asked extends readonly unknown[], Answer>(
  ask: (engine: LearnEngine, ...asked: Asked) => Promise<Answer>,
): (engine: LearnEngine, ...asked: Asked) => Promise<Answer> {
  const engines = new WeakMap<LearnEngine, Map<string, Promise<Answer>>>();
  return (engine, ...asked) => {
    const known = engines.get(engine) ?? new Map<string, Promise<Answer>>();
    engines.set(engine, known);
    const key = JSON.stringify(asked);
    const answer = known.get(key) ?? ask(engine, ...asked);
    // The least recently used is removed first.
    known.delete(key);
    known.set(key, answer);
    if (known.size > KEPT) known.delete(known.keys().next().value!);
    answer.catch(() => known.delete(key));
    return answer;
  };
}
