/** Plain data of what frameworks make: the proxies of Vue, Svelte and MobX cannot be sent to a worker as they are. */
import { StrutError } from "../engine/errors";

/** Deepest nesting: what is deeper holds itself. */
const MAX_DEPTH = 32;

/** A copy whose objects and arrays are plain, at any depth; files, buffers and typed arrays stay what they are. */
export function plain<T>(value: T, depth = 0): T {
  if (typeof value !== "object" || value === null || depth > MAX_DEPTH) return value;
  if (Array.isArray(value)) return value.map((each) => plain(each as unknown, depth + 1)) as T;
  const prototype: unknown = Object.getPrototypeOf(value);
  // A class of its own, such as `Blob`, is no data. Those of frames have another `Object`.
  if (prototype !== null && Object.getPrototypeOf(prototype) !== null) return value;
  return Object.fromEntries(Object.entries(value).map(([key, each]) => [key, plain(each as unknown, depth + 1)])) as T;
}

/**
 * Sends a message, and where something in it cannot be sent, a plain copy of it.
 * @throws StrutError `bad-input` where that cannot be sent either
 */
export function sendPlain<T>(message: T, send: (message: T) => void): void {
  try {
    send(message);
  } catch {
    try {
      send(plain(message));
    } catch (cause) {
      const text = "Something that was given cannot be sent to the engine: it is no plain data.";
      throw new StrutError({ code: "bad-input", message: text, hint: "Give numbers, texts, lists and files." }, cause);
    }
  }
}
