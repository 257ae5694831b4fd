/**
 * A crowd in a worker of its own, one tick ahead of the display. Three buffers are exchanged: the two that are
 * displayed, as images between two ticks need both, and the next.
 */

import type { FieldVertex, People, Place } from "../../engine/crowd/limits";
import { type StrutError, toStrutError } from "../../engine/errors";
import type { CallOptions } from "../protocol";
import type { WorkerPort } from "../rpc";
import { RpcClient, remote } from "../rpc_client";
import { type Clock, PAGE_CLOCK } from "./clock";
import type { CrowdCalls, CrowdFacts, CrowdStart, CrowdTick } from "./protocol";

export type { CrowdFacts, CrowdStart, CrowdTick } from "./protocol";

/** Settings of a crowd that depend on its agents. */
interface CrowdChoices {
  /** Computes the styles by place from the available styles; overrides the start's field. */
  fieldOf?: (styles: readonly string[]) => readonly FieldVertex[];
  /** Computes the bones on which the joints are placed from the crowd's own, 21 × xyz in metres; by default the crowd's own. */
  bonesOf?: (proportions: Float32Array) => Float32Array;
}

/** Dependencies that tests replace. */
interface CrowdSurroundings {
  spawn?: () => WorkerPort;
  clock?: Clock;
}

function spawnWorker(): WorkerPort {
  return new Worker(new URL("./crowd_worker.ts", import.meta.url), { type: "module", name: "strut crowd" });
}

/**
 * Opens a crowd, which runs from then on. The caller disposes of it.
 * @throws StrutError if the agents or the start are invalid, or `cancelled`
 */
export async function createCrowd(
  people: People,
  { signal, bonesOf, fieldOf, ...start }: CrowdStart & CrowdChoices & Pick<CallOptions, "signal">,
  { spawn = spawnWorker, clock = PAGE_CLOCK }: CrowdSurroundings = {},
): Promise<Crowd> {
  const rpc = new RpcClient<CrowdCalls>(spawn, "crowd");
  try {
    // Agents added after the field is set start in its styles.
    const first = fieldOf ? { ...start, count: Math.min(1, start.count) } : start;
    const facts = await rpc.call("open", [people, first], { signal });
    if (fieldOf) {
      await rpc.call("setField", [fieldOf(facts.styles)], { signal });
      await rpc.call("setCount", [start.count], { signal });
    }
    if (bonesOf) await rpc.call("setBones", [bonesOf(facts.proportions)], { signal });
    return new Crowd(rpc, facts, start.count, clock);
  } catch (thrown) {
    rpc.dispose();
    throw thrown;
  }
}

/** A crowd that runs until it is disposed of. */
export class Crowd implements CrowdFacts {
  readonly styles: readonly string[];
  readonly proportions: Float32Array;
  readonly rateHz: number;
  /** Receives all agents, {@link rateHz} times a second. The arrays belong to the caller until the tick after the next. */
  onTick: ((tick: CrowdTick) => void) | undefined;
  /** The worker is too slow; the number of agents was halved. */
  onHalved: ((count: number) => void) | undefined;
  /** The crowd has stopped permanently. */
  onError: ((error: StrutError) => void) | undefined;

  /** Speed of time; 1 is real time. */
  speed = 1;

  private readonly calls: CrowdCalls;
  /** The last tick and the one before. */
  private shown: CrowdTick[] = [];
  private next: CrowdTick | undefined;
  /** Settles when the next tick has arrived. */
  private asking: Promise<void> = Promise.resolve();
  private isPlaying = true;
  private isOver = false;
  private due: number;
  private wait: (() => void) | undefined;

  constructor(
    private readonly rpc: RpcClient<CrowdCalls>,
    facts: CrowdFacts,
    private readonly asked: number,
    private readonly clock: Clock,
  ) {
    ({ styles: this.styles, proportions: this.proportions, rateHz: this.rateHz } = facts);
    this.calls = remote(rpc);
    this.due = clock.now();
    this.ask();
  }

  /** Number of agents in the last tick. */
  get count(): number {
    return this.shown[0]?.count ?? this.asked;
  }

  /** Whether the crowd is playing. */
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

  /** Shows the next tick while paused. */
  async step(): Promise<void> {
    await this.asking;
    if (!this.isPlaying) this.show();
  }

  /** Changes the number of agents, from the tick after the next on. @throws StrutError if there are too few or too many */
  setCount(count: number): Promise<void> {
    return this.calls.setCount(count);
  }

  /**
   * Sets the styles by place, from each agent's next step on, or from now on for agents that perform a motion.
   * @throws StrutError if a vertex is invalid; nothing changes then
   */
  setField(vertices: readonly FieldVertex[]): Promise<void> {
    return this.calls.setField(vertices);
  }

  /**
   * Sets a route that all agents follow: a loop if its ends meet, otherwise back and forth. An empty one removes the
   * route.
   * @throws StrutError if it is invalid; nothing changes then
   */
  setRoute(points: readonly Place[]): Promise<void> {
    return this.calls.setRoute(points);
  }

  /**
   * A BVH file of an agent's next seconds, without interaction with other agents.
   * @throws StrutError if the index is out of range
   */
  exportBvh(person: number, secs: number): Promise<string> {
    return this.calls.exportBvh(person, secs);
  }

  dispose(): void {
    this.end();
    this.rpc.dispose();
  }

  /** Makes the worker write the next tick into a buffer that is no longer used. */
  private ask(spare?: ArrayBuffer): void {
    const answer = this.rpc.call("tick", [spare], { transfer: spare ? [spare] : [] });
    this.asking = answer.then(
      (tick) => {
        this.next = tick;
        this.schedule();
      },
      (thrown) => this.fail(toStrutError(thrown)),
    );
  }

  /** Shows the next tick when it is due, or at once if it is late. */
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
    // A delay of more than one tick is not caught up.
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
