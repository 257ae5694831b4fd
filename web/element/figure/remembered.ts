/** Answers of an engine, computed once. */
import type { LearnEngine } from "../../client/learn/protocol";

/** Remembers answers by the engine and what was asked; what failed is asked again. */
export function remembered<Asked extends readonly unknown[], Answer>(
  ask: (engine: LearnEngine, ...asked: Asked) => Promise<Answer>,
): (engine: LearnEngine, ...asked: Asked) => Promise<Answer> {
  const engines = new WeakMap<LearnEngine, Map<string, Promise<Answer>>>();
  return (engine, ...asked) => {
    const known = engines.get(engine) ?? new Map<string, Promise<Answer>>();
    engines.set(engine, known);
    const key = JSON.stringify(asked);
    const answer = known.get(key) ?? ask(engine, ...asked);
    known.set(key, answer);
    answer.catch(() => known.delete(key));
    return answer;
  };
}
