/**
 * Applies settings to a crowd: changes are sent to it, and if the field changes faster than it is applied, only the
 * last one is sent.
 */

import type { Crowd } from "../../../client/crowd/crowd_client";
import type { FieldVertex, Place } from "../../../client/crowd/limits";
import { LatestOnly } from "../../../ui/latest_only";

/** Settings of a crowd. */
interface Conducted {
  playing: boolean;
  speed: number;
  count: number;
  field: readonly FieldVertex[];
  route: readonly Place[];
}

const NOTHING = { count: 0, field: "", route: "" };

export class Conductor {
  readonly #onFailed: (error: unknown) => void;
  readonly #fields = new LatestOnly<readonly FieldVertex[]>((field) => this.#try(this.#crowd?.setField(field)));
  #crowd: Crowd | undefined;
  /** Settings that were sent, lists as text. */
  #sent = NOTHING;

  constructor(onFailed: (error: unknown) => void) {
    this.#onFailed = onFailed;
  }

  /** Sets another crowd, to which nothing has been sent yet. */
  set crowd(crowd: Crowd | undefined) {
    this.#crowd = crowd;
    this.#sent = NOTHING;
  }

  /** The crowd has reduced its number of agents. */
  set count(count: number) {
    this.#sent = { ...this.#sent, count };
  }

  conduct({ playing, speed, count, field, route }: Conducted): void {
    const crowd = this.#crowd;
    if (!crowd) return;
    crowd.playing = playing;
    crowd.speed = speed;
    const before = this.#sent;
    this.#sent = { count, field: JSON.stringify(field), route: JSON.stringify(route) };
    if (count !== before.count) void this.#try(setCount(crowd, count));
    if (this.#sent.field !== before.field) void this.#fields.take(field);
    if (this.#sent.route !== before.route) void this.#try(crowd.setRoute(route));
  }

  /** Reports a failure, unless the crowd was left meanwhile. */
  async #try(work: Promise<void> | undefined): Promise<void> {
    const crowd = this.#crowd;
    try {
      await work;
    } catch (error) {
      if (crowd === this.#crowd) this.#onFailed(error);
    }
  }
}

/** Sets the number of agents; while paused, they are shown at once. */
async function setCount(crowd: Crowd, count: number): Promise<void> {
  await crowd.setCount(count);
  // Ticks already requested have the previous count.
  for (let i = 0; i < 2 && !crowd.playing && crowd.count !== count; i++) await crowd.step();
}
