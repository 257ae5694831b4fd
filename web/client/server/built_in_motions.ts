/** The built-in motions as the server's calls need them. */
import { loadBuiltIn, type PackedMotions } from "../../engine/built_in";
import type { Caller } from "./time_slices";

/** Share of opening that is reported for the download. */
const DOWNLOAD_SHARE = 0.8;

/** The built-in motions, which begin to load with the engine. A load that failed is tried again when they are needed. */
export class BuiltInMotions {
  private fraction = 0;
  private loading: Promise<PackedMotions> | undefined;
  private readonly waiting = new Set<Caller>();

  constructor() {
    void this.start().catch(() => {});
  }

  async load(caller: Caller): Promise<PackedMotions> {
    this.waiting.add(caller);
    try {
      this.report(caller);
      return await this.start();
    } finally {
      this.waiting.delete(caller);
    }
  }

  private start(): Promise<PackedMotions> {
    this.loading ??= loadBuiltIn((fraction) => {
      this.fraction = fraction;
      for (const caller of this.waiting) this.report(caller);
    }).catch((thrown) => {
      this.loading = undefined;
      throw thrown;
    });
    return this.loading;
  }

  private report(caller: Caller): void {
    if (this.fraction < 1)
      caller.report({ label: "Loading the built-in motions", fraction: this.fraction * DOWNLOAD_SHARE });
  }
}
