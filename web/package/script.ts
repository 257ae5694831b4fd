/** Classic scripts of the package that hand something over: they need no origin, unlike modules and what is fetched. */
import { StrutError } from "../engine/errors";
import { trusted } from "./start";

/** The name under which a script calls what it has for the page. */
export const RECEIVER = "strutReceive";

/**
 * Runs a script that calls `strutReceive`, and resolves with what it gave. One after the other: all have the same receiver.
 * @throws StrutError `load` with the sentence and the hint where it cannot be had
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
      // A script that ended without giving anything is not the one that was meant.
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
