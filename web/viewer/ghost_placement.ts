/**
 * Where the ghost of the input walks.
 *
 * Beside the character, the ghost keeps its own path: its whole world is turned and moved once, so that its feet never
 * slide. Style changes speed and heading, so the two drift apart; when the ghost has strayed from the character's side
 * it is set there anew. Over the character, its hips and heading are put on the character's every frame, so that only
 * the pose differs.
 */

import { createWorldPose, headingOf, placePose, restPose, type WorldPose, worldFromLocal } from "./humanoid";

/** Distance of the ghost's hips from the character's, to its right, metres. */
export const BESIDE = 1;
/** Distance from that place at which the ghost is set there anew, metres. */
export const STRAY = 0.7;

/** Keeps the transform from the input's world to the ghost's. */
export class GhostPlacement {
  /** The placed pose. */
  readonly pose = restPose();
  readonly #world = createWorldPose();
  #turn = 0;
  #x = 0;
  #z = 0;
  #placed = false;

  /** Chooses the place anew with the next pose. */
  reset(): void {
    this.#placed = false;
  }

  /** Places an input pose into {@link pose}; returns whether the ghost had strayed and was set anew. */
  place(input: ArrayLike<number>, proportions: ArrayLike<number>, body: WorldPose, beside: boolean): boolean {
    if (!beside || !this.#placed) {
      this.#anchor(input, proportions, body, beside);
      return false;
    }
    placePose(input, this.#turn, this.#x, this.#z, this.pose);
    const [x, z] = wantedPlace(body, beside);
    if (Math.hypot(this.pose[0]! - x, this.pose[2]! - z) <= STRAY) return false;
    this.#anchor(input, proportions, body, beside);
    return true;
  }

  #anchor(input: ArrayLike<number>, proportions: ArrayLike<number>, body: WorldPose, beside: boolean): void {
    worldFromLocal(proportions, input, this.#world);
    const heading = headingOf(body, 0);
    this.#turn = heading - headingOf(this.#world, heading);
    const [x, z] = wantedPlace(body, beside);
    placePose(input, this.#turn, 0, 0, this.pose);
    this.#x = x - this.pose[0]!;
    this.#z = z - this.pose[2]!;
    placePose(input, this.#turn, this.#x, this.#z, this.pose);
    this.#placed = true;
  }
}

/** The hips' place on the ground. */
function wantedPlace(body: WorldPose, beside: boolean): [x: number, z: number] {
  const heading = headingOf(body, 0);
  const side = beside ? BESIDE : 0;
  return [body.positions[0]! - side * Math.cos(heading), body.positions[2]! + side * Math.sin(heading)];
}
