/** Errors that the WASM packages return as values. */
import { StrutError, type StrutErrorCode } from "./errors";

/** An error as wasm-bindgen returns it; every package has the same class. */
interface ValueError {
  readonly code: string;
  readonly message: string;
  readonly hint: string;
  free(): void;
}

/** The part of a package's bindings that concerns errors. */
export interface ErrorClass {
  EngineError: { prototype: ValueError };
}

/**
 * Converts a value that a package threw to a {@link StrutError} if it is one of its error objects, which is freed;
 * otherwise `undefined`.
 */
export function valueError({ EngineError }: ErrorClass, thrown: unknown): StrutError | undefined {
  if (!Object.prototype.isPrototypeOf.call(EngineError.prototype, thrown as object)) return undefined;
  const error = thrown as ValueError;
  const { code, message, hint } = error;
  error.free();
  return new StrutError({ code: code as StrutErrorCode, message, hint });
}
