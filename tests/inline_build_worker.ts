/** The build worker on this thread, with the real module; messages arrive asynchronously, as from a real one. */
import { serveBuilds } from "../web/client/build/server";
import type { Request } from "../web/client/rpc";
import { LocalPort } from "../web/package/local_port";

export class InlineBuildWorker extends LocalPort {
  /** All requests to the worker. */
  readonly received: Request[] = [];
  terminated = false;

  constructor() {
    super(serveBuilds);
  }

  override postMessage(message: Request, transfer: Transferable[]): void {
    this.received.push(message);
    super.postMessage(message, transfer);
  }

  override terminate(): void {
    this.terminated = true;
    super.terminate();
  }
}
