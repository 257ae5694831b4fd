/** Keeps the last requested model open, whatever was requested or finished loading in between. */

interface ModelLoaderOptions<Request, Model> {
  /** Whether two requests are for the same model. Requests are new objects each time, so identity cannot be compared. */
  isSame: (a: Request, b: Request) => boolean;
  load: (request: Request) => Promise<Model>;
  /** Cancels the current load. */
  cancel: () => void;
  /** Called when the model of the last request is open. The previous one is disposed of after this call. */
  onReady: (model: Model, request: Request) => void;
  /** Called when the last request failed or was cancelled by the user. */
  onFailed: (error: unknown, request: Request) => void;
}

export class ModelLoader<Request extends object, Model extends { dispose(): void }> {
  readonly #options: ModelLoaderOptions<Request, Model>;
  #open: { request: Request; model: Model } | undefined;
  #pending: Request | undefined;
  #failed = false;
  /** Counter of requests, by which outdated results are recognised. */
  #round = 0;

  constructor(options: ModelLoaderOptions<Request, Model>) {
    this.#options = options;
  }

  /** The last opened model: of a former request while {@link loading}, or if the last one {@link failed}. */
  get model(): Model | undefined {
    return this.#open?.model;
  }

  /** The request of {@link model}. */
  get opened(): Request | undefined {
    return this.#open?.request;
  }

  get loading(): boolean {
    return this.#pending !== undefined;
  }

  get failed(): boolean {
    return this.#failed;
  }

  /** Whether the model of a request is open and nothing else was requested since. */
  isReady(request: Request): boolean {
    return !this.loading && !this.#failed && this.#isOpen(request);
  }

  /** Opens the model of a request, unless it is open or loading. */
  async request(request: Request): Promise<void> {
    if (this.isReady(request) || (this.#pending && this.#options.isSame(this.#pending, request))) return;
    const open = this.#open;
    if (open && this.#isOpen(request)) {
      this.cancel();
      this.#options.onReady(open.model, open.request);
    } else await this.#load(request);
  }

  /** Cancels the current load without a report; the open model stays open. */
  cancel(): void {
    this.#round += 1;
    this.#failed = false;
    if (!this.loading) return;
    this.#pending = undefined;
    this.#options.cancel();
  }

  dispose(): void {
    this.cancel();
    this.#open?.model.dispose();
    this.#open = undefined;
  }

  #isOpen(request: Request): boolean {
    return this.#open !== undefined && this.#options.isSame(this.#open.request, request);
  }

  async #load(request: Request): Promise<void> {
    this.#round += 1;
    const round = this.#round;
    this.#pending = request;
    this.#failed = false;
    const result = await this.#options.load(request).then(
      (model) => ({ model }),
      (error: unknown) => ({ error }),
    );
    if (round !== this.#round) {
      if ("model" in result) result.model.dispose();
      return;
    }
    this.#pending = undefined;
    if ("error" in result) {
      this.#failed = true;
      this.#options.onFailed(result.error, request);
      return;
    }
    const former = this.#open?.model;
    this.#open = { request, model: result.model };
    this.#options.onReady(result.model, request);
    former?.dispose();
  }
}
