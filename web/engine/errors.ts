/** The engine's errors, as JavaScript sees them. */

/**
 * Codes of {@link StrutError}.
 * - `bad-file`: the bytes are not what they should be;
 * - `bad-input`: an argument or an option is outside its range;
 * - `not-open`: a database or an input is needed first;
 * - `cancelled`: the caller's signal was aborted;
 * - `disposed`: the object was used after `dispose()`;
 * - `fault`: a bug in the engine; its instance was lost.
 */
export type StrutErrorCode = "bad-file" | "bad-input" | "not-open" | "cancelled" | "disposed" | "fault";

/** What a {@link StrutError} is made of: travels between threads. */
export interface ErrorParts {
  code: StrutErrorCode;
  /** A sentence for people. */
  message: string;
  /** What to do about it, or empty. */
  hint: string;
}

/** Every rejection of Strut's. */
export class StrutError extends Error {
  override readonly name = "StrutError";
  readonly code: StrutErrorCode;
  /** What to do about it, or empty. */
  readonly hint: string;

  constructor({ code, message, hint }: ErrorParts) {
    super(message);
    this.code = code;
    this.hint = hint;
  }

  /** The error as plain data. */
  parts(): ErrorParts {
    return { code: this.code, message: this.message, hint: this.hint };
  }
}

/** The error of an aborted call. */
export function cancelled(): StrutError {
  return new StrutError({ code: "cancelled", message: "The call was cancelled.", hint: "" });
}

/** The error of a use after `dispose()`. */
export function disposed(what: string): StrutError {
  return new StrutError({ code: "disposed", message: `The ${what} was used after dispose().`, hint: "" });
}

/** Any thrown value as a {@link StrutError}; what is not one already is a fault. */
export function toStrutError(thrown: unknown): StrutError {
  if (thrown instanceof StrutError) return thrown;
  const message = thrown instanceof Error ? thrown.message : String(thrown);
  return new StrutError({
    code: "fault",
    message: `The engine failed: ${message}`,
    hint: "This is a bug in Strut; please report it with the file that caused it.",
  });
}
