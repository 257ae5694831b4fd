/** Measurements of the search by kd-trees on the input, once per request. */
import { type CallOptions, type InputInfo, isCancellation, type SearchFigures } from "../../../client/protocol";

/** The search to measure. */
export interface SearchRequest {
  input: InputInfo;
  /** Number of neighbours in every class. */
  neighbours: number;
  /** Number of candidates from every kd-tree. */
  candidates: number;
}

/** Measures searches. */
interface SearchMeter {
  /** The measurements of a request; `undefined` if there are none. */
  measure(request: SearchRequest, call: CallOptions): Promise<SearchFigures | undefined>;
  /** Called when results have arrived, or the progress has changed. */
  onChange(): void;
  /** Called when measuring failed; cancellations are not reported. */
  onError(error: unknown): void;
}

export class SearchMeasurement {
  /** The results of the current request; `undefined` until they arrive. */
  figures: SearchFigures | undefined;
  /** Progress of the measurement, 0–1. */
  fraction = 0;
  readonly #meter: SearchMeter;
  #request: SearchRequest | undefined;
  #running: AbortController | undefined;

  constructor(meter: SearchMeter) {
    this.#meter = meter;
  }

  /** Measures a request, `undefined` for none. Does nothing while the request is unchanged. */
  request(request: SearchRequest | undefined): void {
    if (isSame(request, this.#request)) return;
    this.stop();
    this.#request = request;
    this.figures = undefined;
    if (request) void this.#measure(request);
  }

  /** Stops measuring; the next request restarts it unless there are results. */
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
