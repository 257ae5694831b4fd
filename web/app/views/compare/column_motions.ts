/** The motions of the columns. Each is made once, when a column first needs it, and kept while a column shows it. */
import { type InputInfo, isCancellation, isFault } from "../../../client/protocol";
import { measure } from "../../../player/measured";
import type { MotionRequest } from "./columns";
import type { ColumnMotion, MeasuredMotion } from "./figures";

/** Motions are made when the requests have not changed for this time. */
const SETTLE_MS = 150;

/** The input of all columns, and its bone offsets: 21 × xyz, metres. */
interface ComparedInput {
  input: InputInfo;
  proportions: ArrayLike<number>;
}

/** Makes motions. */
interface MotionMaker {
  /** Makes the requested motion; `undefined` if there is none. */
  make(request: MotionRequest): Promise<ColumnMotion | undefined>;
  /** Cancels the current motion: its promise rejects. */
  cancel(): void;
  /** Called when a motion is finished. */
  onMade(): void;
  /** Called when a motion could not be made; cancellations are not reported. */
  onError(error: unknown): void;
}

export class ColumnMotions {
  readonly #maker: MotionMaker;
  #of: ComparedInput | undefined;
  #requests: readonly MotionRequest[] = [];
  /** Motions by their key; `undefined` for a key without a motion. */
  readonly #motions = new Map<string, MeasuredMotion | undefined>();
  /** Keys of motions that failed or were cancelled. They are not made again until another motion is requested. */
  readonly #failed = new Set<string>();
  /** Key of the motion in progress. */
  #making: string | undefined;
  #settle: ReturnType<typeof setTimeout> | undefined;
  #paused = false;

  constructor(maker: MotionMaker) {
    this.#maker = maker;
  }

  /** The motion of a key; `undefined` until it is made, and if there is none. */
  get(key: string): MeasuredMotion | undefined {
    return this.#motions.get(key);
  }

  /** Whether a key is known to have no motion. */
  isMissing(key: string): boolean {
    return this.#motions.has(key) && this.#motions.get(key) === undefined;
  }

  /** Makes the missing motions. Does nothing while input and requests are unchanged. */
  request(of: ComparedInput, requests: readonly MotionRequest[]): void {
    const sameInput = this.#of?.input === of.input;
    if (sameInput && keysOf(requests) === keysOf(this.#requests)) return;
    this.#of = of;
    this.#requests = requests;
    this.#failed.clear();
    if (!sameInput) this.#motions.clear();
    if (!sameInput || !requests.some(({ key }) => key === this.#making)) this.#stop();
    this.#makeSoon();
  }

  /** Stops making motions until {@link resume}; finished ones are kept. */
  pause(): void {
    this.#paused = true;
    clearTimeout(this.#settle);
    this.#stop();
  }

  /** Makes the missing motions, including those that failed. */
  resume(): void {
    this.#paused = false;
    this.#failed.clear();
    this.#makeSoon();
  }

  #stop(): void {
    if (this.#making === undefined) return;
    this.#making = undefined;
    this.#maker.cancel();
  }

  #makeSoon(): void {
    clearTimeout(this.#settle);
    if (this.#paused) return;
    this.#settle = setTimeout(() => {
      this.#settle = undefined;
      void this.#makeNext();
    }, SETTLE_MS);
  }

  /** Makes the missing motions one after another; new requests wait until they settle. */
  async #makeNext(): Promise<void> {
    const of = this.#of;
    const next = this.#requests.find(({ key }) => !this.#motions.has(key) && !this.#failed.has(key));
    if (!of || this.#making !== undefined || this.#settle !== undefined || this.#paused) return;
    if (!next) {
      this.#forgetUnused();
      return;
    }
    this.#making = next.key;
    const isCurrent = () => this.#making === next.key && this.#of === of;
    try {
      const motion = await this.#make(next);
      if (!isCurrent()) return;
      this.#motions.set(next.key, motion && measure(motion, of.proportions));
      this.#maker.onMade();
    } catch (error) {
      if (!isCurrent()) return;
      this.#failed.add(next.key);
      if (!isCancellation(error)) this.#maker.onError(error);
    }
    this.#making = undefined;
    await this.#makeNext();
  }

  /** Retries once after an engine fault, when the engine has been restarted. */
  #make(request: MotionRequest): Promise<ColumnMotion | undefined> {
    return this.#maker.make(request).catch((error) => {
      if (!isFault(error)) throw error;
      return this.#maker.make(request);
    });
  }

  /** Removes motions that no column shows: the motions of long clips are large. */
  #forgetUnused(): void {
    const used = new Set(this.#requests.map(({ key }) => key));
    for (const key of this.#motions.keys()) if (!used.has(key)) this.#motions.delete(key);
  }
}

const keysOf = (requests: readonly MotionRequest[]): string => requests.map(({ key }) => key).join("\n");
