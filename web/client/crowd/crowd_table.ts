/** The worker's side: a single crowd. */
import { Crowd } from "../../engine/crowd/crowd";
import { StrutError } from "../../engine/errors";
import { CROWD_WALKER_FLOATS } from "../../humanoid";
import type { CrowdCalls } from "./protocol";

/** Ticks longer than this are slow, milliseconds. Several slow ticks in a row halve the count. */
const SLOW_MS = 25;
const SLOW_TICKS = 3;

/** The functions that answer the calls. @param now a clock, milliseconds */
export function createCrowdTable(now: () => number = () => performance.now()): CrowdCalls {
  let opened: Crowd | undefined;
  let slow = 0;
  const crowd = () => {
    if (opened) return opened;
    throw new StrutError({ code: "not-open", message: "No crowd is open.", hint: "" });
  };

  return {
    async open(people, { count, seed = 1, field = [], route = [] }) {
      const made = await Crowd.open(people, { count, seed });
      try {
        made.setField(field);
        made.setRoute(route);
      } catch (thrown) {
        made.dispose();
        throw thrown;
      }
      opened = made;
      const { styles, proportions, rateHz } = made;
      return { styles, proportions, rateHz };
    },

    async tick(buffer) {
      const { styles, radius } = crowd();
      const before = now();
      crowd().tick();
      const { count } = crowd();
      const floats = count * CROWD_WALKER_FLOATS;
      const bytes = 4 * floats + count * styles.length;
      const into = buffer?.byteLength === bytes ? buffer : new ArrayBuffer(bytes);
      const joints = new Float32Array(into, 0, floats);
      const weights = new Uint8Array(into, 4 * floats);
      crowd().read(joints, weights);
      const tickMs = now() - before;
      slow = tickMs > SLOW_MS ? slow + 1 : 0;
      const halves = slow >= SLOW_TICKS && count > 1;
      if (halves) {
        slow = 0;
        crowd().setCount(Math.floor(count / 2));
      }
      return { count, radius, joints, weights, tickMs, halves };
    },

    async setCount(count) {
      crowd().setCount(count);
      slow = 0;
    },

    async setField(vertices) {
      crowd().setField(vertices);
    },

    async setRoute(points) {
      crowd().setRoute(points);
    },

    async setBones(offsets) {
      crowd().setBones(offsets);
    },

    async exportBvh(person, secs) {
      return crowd().toBvh(person, secs);
    },
  };
}
