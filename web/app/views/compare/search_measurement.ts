/** What is measured of the search by kd-trees on the input, once for each request. */
import { type CallOptions, type InputInfo, isCancellation, type SearchFigures } from "../../../client/protocol";

/** What is to be measured. */
export interface SearchRequest {
  input: InputInfo;
  /** Neighbours that are looked for in every class. */
  neighbours: number;
  /** Candidates of every kd-tree. */
  candidates: number;
}

/** What measures. */
export interface SearchMeter {
  /** The figures of a request; `undefined` where there are none. */
  measure(request: SearchRequest, call: CallOptions): Promise<SearchFigures | undefined>;
  /** Figures are there, or measuring has come farther. */
  onChange(): void;
  /** The figures could not be had; cancellations are not reported. */
  onError(error: unknown): void;
}

export class SearchMeasurement {
  /** The figures of the present request; `undefined` until they are there. */
  figures: SearchFigures | undefined;
  /** How far measuring has come, 0–1. */
  fraction = 0;
  readonly #meter: SearchMeter;
  #request: SearchRequest | undefined;
  #running: AbortController | undefined;

  constructor(meter: SearchMeter) {
    this.#meter = meter;
  }

  /** Measures what is requested, `undefined` for nothing; nothing happens while the request is the same as before. */
  request(request: SearchRequest | undefined): void {
    if (isSame(request, this.#request)) return;
    this.stop();
    this.#request = request;
    this.figures = undefined;
    if (request) void this.#measure(request);
  }

  /** Stops measuring; the next request begins anew unless the figures are there. */
  stop(): void {
    this.#running?.abort();
    this.#running = undefined;
    this.fraction = 0;
    if (!this.figures) this.#request = undefined;
  }

  async #measure(request: SearchRequest): Promise<void> {
    const running = new AbortController();
    this.#running = running;
    const onProgress = ({ fraction }: { fraction: number }) => {
      if (this.#running !== running) return;
      this.fraction = fraction;
      this.#meter.onChange();
    };
    try {
      const figures = await this.#meter.measure(request, { signal: running.signal, onProgress });
      if (this.#running !== running) return;
      this.figures = figures;
      this.#running = undefined;
      this.#meter.onChange();
    } catch (error) {
      if (this.#running !== running) return;
      this.stop();
      if (!isCancellation(error)) this.#meter.onError(error);
    }
  }
}

function isSame(a: SearchRequest | undefined, b: SearchRequest | undefined): boolean {
  return a?.input === b?.input && a?.neighbours === b?.neighbours && a?.candidates === b?.candidates;
}
