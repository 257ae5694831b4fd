/** Plain copies of framework objects: the proxies of Vue, Svelte and MobX cannot be sent to a worker. */
import { StrutError } from "../engine/errors";

/** Deepest nesting; deeper objects are treated as circular. */
const MAX_DEPTH = 32;

/** A copy whose objects and arrays are plain, at any depth. Files, buffers and typed arrays are kept. */
export function plain<T>(value: T, depth = 0): T {
  if (typeof value !== "object" || value === null || depth > MAX_DEPTH) return value;
  if (Array.isArray(value)) return value.map((each) => plain(each as unknown, depth + 1)) as T;
  const prototype: unknown = Object.getPrototypeOf(value);
  // An instance of a class, such as `Blob`, is not plain data. Objects of other frames have another `Object`.
  if (prototype !== null && Object.getPrototypeOf(prototype) !== null) return value;
  return Object.fromEntries(Object.entries(value).map(([key, each]) => [key, plain(each as unknown, depth + 1)])) as T;
}

/**
 * Sends a message, or a plain copy of it if it cannot be cloned.
 * @throws StrutError `bad-input` if the copy cannot be sent either
 */
export function sendPlain<T>(message: T, send: (message: T) => void): void {
  try {
    send(message);
  } catch {
    try {
      send(plain(message));
    } catch (cause) {
      const text = "An argument cannot be sent to the engine, because it is not plain data.";
      throw new StrutError(
        { code: "bad-input", message: text, hint: "Pass only numbers, strings, arrays, plain objects and files." },
        cause,
      );
    }
  }
}
