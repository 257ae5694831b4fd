/** The engine's errors, as JavaScript sees them. */

/**
 * Codes of {@link StrutError}.
 * - `bad-file`: the bytes are not in the expected format;
 * - `bad-input`: an argument or an option is outside its range;
 * - `not-open`: a database, a motion or a session is needed first, or was closed after a fault;
 * - `cancelled`: the caller's signal was aborted; `cause` is the signal's reason;
 * - `disposed`: the object was used after `dispose()`;
 * - `load`: a part of Strut could not be loaded;
 * - `unsupported`: the browser lacks something that Strut needs;
 * - `licence`: the author of a model does not allow it;
 * - `gpu-lost`: the GPU returned no result; the CPU can be used instead;
 * - `fault`: a bug in the engine; its instance was lost.
 */
export type StrutErrorCode =
  | "bad-file"
  | "bad-input"
  | "not-open"
  | "cancelled"
  | "disposed"
  | "load"
  | "unsupported"
  | "licence"
  | "gpu-lost"
  | "fault";

/** Contents of a {@link StrutError} as plain data, which travels between threads. */
export interface ErrorParts {
  code: StrutErrorCode;
  /** A sentence for the user. */
  message: string;
  /** What to do about it, or empty. */
  hint: string;
}

/** The error of every rejection: all rejections are `StrutError`s. */
export class StrutError extends Error {
  /** Always `StrutError`. */
  override readonly name = "StrutError";
  /** What kind of error it is. */
  readonly code: StrutErrorCode;
  /** What to do about it, or empty. */
  readonly hint: string;

  constructor({ code, message, hint }: ErrorParts, cause?: unknown) {
    super(message, cause === undefined ? undefined : { cause });
    this.code = code;
    this.hint = hint;
  }

  /** The error as plain data. */
  parts(): ErrorParts {
    return { code: this.code, message: this.message, hint: this.hint };
  }
}

/** The error of an aborted call. @param reason reason of the signal */
export function cancelled(reason?: unknown): StrutError {
  return new StrutError({ code: "cancelled", message: "The call was cancelled.", hint: "" }, reason);
}

/** The error of a use after `dispose()`. */
export function disposed(what: string): StrutError {
  return new StrutError({ code: "disposed", message: `The ${what} was used after dispose().`, hint: "" });
}

/** The error of a bug. @param what what failed: a sentence without its full stop */
export function fault(what: string): StrutError {
  const hint = "This is a bug in Strut; please report it with the file that caused it.";
  return new StrutError({ code: "fault", message: `${what}.`, hint });
}

/** Converts any thrown value to a {@link StrutError}. A value that is not one already becomes a fault. */
export function toStrutError(thrown: unknown): StrutError {
  if (thrown instanceof StrutError) return thrown;
  const message = thrown instanceof Error ? thrown.message : String(thrown);
  // A panic throws its message. A trap without a message is a failed allocation.
  const memory = /^unreachable/i.test(message);
  return fault(memory ? "The engine ran out of memory" : `The engine failed: ${message.replace(/\.$/, "")}`);
}

/** Whether an error only reports that its call was cancelled. */
export function isCancellation(error: unknown): boolean {
  const { code, name } = error as { code?: unknown; name?: unknown };
  return code === "cancelled" || name === "AbortError";
}

/** Whether an error reports that a part of Strut could not be loaded. */
export function isUnloaded(error: unknown): boolean {
  return (error as { code?: unknown }).code === "load";
}

/** Whether the engine was restarted because of this error. */
export function isFault(error: unknown): boolean {
  return (error as { code?: unknown }).code === "fault";
}
