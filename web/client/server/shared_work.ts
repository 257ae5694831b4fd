/** Long work whose result several callers wait for. */
import { cancelled } from "../../engine/errors";
import type { Caller } from "../rpc_server";

/** Work that is done once. Its progress is reported to every caller, and it is cancelled when all callers cancel. */
export class SharedWork<T> {
  private readonly callers: Caller[];
  private readonly result: Promise<T>;

  /** Starts the work for its first caller. */
  constructor(work: (caller: Caller) => Promise<T>, first: Caller) {
    this.callers = [first];
    this.result = work({
      isCancelled: () => this.callers.every((caller) => caller.isCancelled()),
      report: (progress) => {
        for (const caller of this.callers) caller.report(progress);
      },
    });
  }

  /**
   * The result, for the first caller or for another one.
   * @throws StrutError `cancelled` if the caller or, meanwhile, all callers were cancelled
   */
  async for(caller: Caller): Promise<T> {
    if (!this.callers.includes(caller)) this.callers.push(caller);
    const result = await this.result;
    if (caller.isCancelled()) throw cancelled();
    return result;
  }
}
