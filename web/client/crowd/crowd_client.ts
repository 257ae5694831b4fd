/**
 * A crowd in a worker of its own, one tick ahead of the picture. Three buffers travel to and fro: two that are shown, as pictures
 * between two ticks need both, and the next.
 */

import type { FieldVertex, People, Place } from "../../engine/crowd/limits";
import { type StrutError, toStrutError } from "../../engine/errors";
import type { CallOptions } from "../protocol";
import { type ClientPort, RpcClient, remote } from "../rpc";
import { type Clock, PAGE_CLOCK } from "./clock";
import type { CrowdCalls, CrowdFacts, CrowdStart, CrowdTick } from "./protocol";

export type { CrowdFacts, CrowdStart, CrowdTick } from "./protocol";

/** How many arguments each call has. */
const ARITY = { open: 2, tick: 1, setCount: 1, setField: 1, setRoute: 1, setBones: 1, exportBvh: 2 } as const;

/** What of a crowd follows from who is there. */
export interface CrowdChoices {
  /** Styles by place, of those that there are; in place of the start's field. */
  fieldOf?: (styles: readonly string[]) => readonly FieldVertex[];
  /** Bones that joints are to lie on, by their own, 21 × xyz in metres; these if missing. */
  bonesOf?: (proportions: Float32Array) => Float32Array;
}

/** What tests replace. */
export interface CrowdSurroundings {
  spawn?: () => ClientPort;
  clock?: Clock;
}

function spawnWorker(): ClientPort {
  return new Worker(new URL("./crowd_worker.ts", import.meta.url), { type: "module", name: "strut crowd" });
}

/**
 * Opens a crowd, which walks or performs from then on; the caller disposes of it.
 * @throws StrutError with what is wrong with the people or the start, or `cancelled`
 */
export async function createCrowd(
  people: People,
  { signal, bonesOf, fieldOf, ...start }: CrowdStart & CrowdChoices & Pick<CallOptions, "signal">,
  { spawn = spawnWorker, clock = PAGE_CLOCK }: CrowdSurroundings = {},
): Promise<Crowd> {
  const rpc = new RpcClient(spawn, "crowd");
  try {
    // Those who come when there is a field begin in its styles.
    const first = fieldOf ? { ...start, count: Math.min(1, start.count) } : start;
    const facts = (await rpc.call("open", [people, first], signal)) as CrowdFacts;
    if (fieldOf) {
      await rpc.call("setField", [fieldOf(facts.styles)], signal);
      await rpc.call("setCount", [start.count], signal);
    }
    if (bonesOf) await rpc.call("setBones", [bonesOf(facts.proportions)], signal);
    return new Crowd(rpc, facts, start.count, clock);
  } catch (thrown) {
    rpc.dispose();
    throw thrown;
  }
}

/** A crowd that walks or performs until it is disposed of. */
export class Crowd implements CrowdFacts {
  readonly styles: readonly string[];
  readonly proportions: Float32Array;
  readonly rateHz: number;
  /** Everybody, {@link rateHz} times a second. The arrays are the caller's until the tick after the next. */
  onTick: ((tick: CrowdTick) => void) | undefined;
  /** The worker is too slow, and has fewer people now. */
  onHalved: ((count: number) => void) | undefined;
  /** The crowd has stopped for good. */
  onError: ((error: StrutError) => void) | undefined;

  /** How fast time goes on; 1 is that of the world. */
  speed = 1;

  private readonly calls: CrowdCalls;
  /** The last tick and the one before. */
  private shown: CrowdTick[] = [];
  private next: CrowdTick | undefined;
  /** Until the next tick is there. */
  private asking: Promise<void> = Promise.resolve();
  private isPlaying = true;
  private isOver = false;
  private due: number;
  private wait: (() => void) | undefined;

  constructor(
    private readonly rpc: RpcClient,
    facts: CrowdFacts,
    private readonly asked: number,
    private readonly clock: Clock,
  ) {
    ({ styles: this.styles, proportions: this.proportions, rateHz: this.rateHz } = facts);
    this.calls = remote<CrowdCalls>(rpc, ARITY);
    this.due = clock.now();
    this.ask();
  }

  /** People of the last tick. */
  get count(): number {
    return this.shown[0]?.count ?? this.asked;
  }

  /** Whether time goes on. */
  get playing(): boolean {
    return this.isPlaying;
  }

  set playing(playing: boolean) {
    if (playing === this.isPlaying || this.isOver) return;
    this.isPlaying = playing;
    this.wait?.();
    this.wait = undefined;
    this.due = this.clock.now();
    if (playing) this.schedule();
  }

  /** Time between two ticks, milliseconds. */
  get periodMs(): number {
    return 1000 / (this.rateHz * this.speed);
  }

  /** Shows the next tick while time does not go on. */
  async step(): Promise<void> {
    await this.asking;
    if (!this.isPlaying) this.show();
  }

  /** More people or fewer, from the tick after the next on. @throws StrutError if there are too few or too many */
  setCount(count: number): Promise<void> {
    return this.calls.setCount(count);
  }

  /** Styles by place, from everybody's next step on, or from now on for performers. @throws StrutError if a vertex is none; nothing changes then */
  setField(vertices: readonly FieldVertex[]): Promise<void> {
    return this.calls.setField(vertices);
  }

  /**
   * A way that everybody follows: round if its ends meet, else there and back; none sets them free.
   * @throws StrutError if it is none; nothing changes then
   */
  setRoute(points: readonly Place[]): Promise<void> {
    return this.calls.setRoute(points);
  }

  /** A BVH file of the next seconds of somebody, as if nobody else were there. @throws StrutError if there is nobody of this number */
  exportBvh(person: number, secs: number): Promise<string> {
    return this.calls.exportBvh(person, secs);
  }

  dispose(): void {
    this.end();
    this.rpc.dispose();
  }

  /** Has the worker write the next tick, into a buffer that nobody needs any more. */
  private ask(spare?: ArrayBuffer): void {
    const answer = this.rpc.call("tick", [spare], undefined, spare ? [spare] : []) as Promise<CrowdTick>;
    this.asking = answer.then(
      (tick) => {
        this.next = tick;
        this.schedule();
      },
      (thrown) => this.fail(toStrutError(thrown)),
    );
  }

  /** Shows the next tick when it is due: at once if it is late. */
  private schedule(): void {
    if (!this.next || this.wait || !this.isPlaying || this.isOver) return;
    this.wait = this.clock.after(Math.max(0, this.due - this.clock.now()), () => {
      this.wait = undefined;
      this.show();
    });
  }

  private show(): void {
    const tick = this.next;
    if (!tick || this.isOver) return;
    const spare = this.shown[1];
    this.shown = [tick, ...this.shown.slice(0, 1)];
    this.next = undefined;
    const [period, now] = [this.periodMs, this.clock.now()];
    // What is late by more than a tick is not made up for.
    this.due = (now - this.due > period ? now : this.due) + period;
    this.ask(spare?.joints.buffer as ArrayBuffer | undefined);
    this.onTick?.(tick);
    if (tick.halves) this.onHalved?.(Math.floor(tick.count / 2));
  }

  private fail(error: StrutError): void {
    if (this.isOver) return;
    this.end();
    this.rpc.dispose();
    this.onError?.(error);
  }

  private end(): void {
    this.isOver = true;
    this.wait?.();
    this.wait = undefined;
  }
}
