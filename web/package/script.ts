/** Classic scripts of the package that return a value: they need no origin, unlike modules and fetched files. */
import { StrutError } from "../engine/errors";
import { trusted } from "./start";

/** The name of the function through which a script returns its value to the page. */
export const RECEIVER = "strutReceive";

/**
 * Runs a script that calls `strutReceive`, and resolves with its argument. Scripts run one after another, since all
 * have the same receiver.
 * @throws StrutError `load` with the sentence and the hint if it cannot be loaded
 */
export function received<T>(address: URL, message: string, hint: string): Promise<T> {
  const next = before.then(() => run<T>(address, message, hint));
  before = next.catch(() => undefined);
  return next;
}

let before: Promise<unknown> = Promise.resolve();

function run<T>(address: URL, message: string, hint: string): Promise<T> {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    const fail = (cause?: unknown) => reject(new StrutError({ code: "load", message, hint }, cause));
    Object.assign(globalThis, { [RECEIVER]: resolve });
    script.onload = () => {
      script.remove();
      // A script that ended without returning a value is not the expected one.
      fail();
    };
    script.onerror = () => {
      script.remove();
      fail();
    };
    try {
      script.src = trusted(address.href) as string;
    } catch (cause) {
      fail(cause);
      return;
    }
    document.head.append(script);
  });
}
