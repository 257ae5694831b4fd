/** Errors that the WASM packages give as values. */
import { StrutError, type StrutErrorCode } from "./errors";

/** An error as wasm-bindgen hands it over; every package has the same class. */
interface ValueError {
  readonly code: string;
  readonly message: string;
  readonly hint: string;
  free(): void;
}

/** The bindings of a package, as far as its errors go. */
export interface ErrorClass {
  EngineError: { prototype: ValueError };
}

/** What a package threw as a {@link StrutError}, if it is an error that it gives as a value; it is freed. */
export function valueError({ EngineError }: ErrorClass, thrown: unknown): StrutError | undefined {
  if (!Object.prototype.isPrototypeOf.call(EngineError.prototype, thrown as object)) return undefined;
  const error = thrown as ValueError;
  const { code, message, hint } = error;
  error.free();
  return new StrutError({ code: code as StrutErrorCode, message, hint });
}
