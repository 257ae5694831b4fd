/**
 * Position of the input's ghost.
 *
 * Next to the character, the ghost keeps its own path: its whole world is rotated and moved once, so that its feet
 * never slide. Style changes speed and heading, so the two drift apart. When the ghost has drifted too far, it is
 * placed again, half of that distance on the opposite side of its place, since it will drift in the same direction again. In
 * overlay mode, the ghost's hips and heading equal the character's in every frame, so that only the pose differs.
 */

import { createWorldPose, headingOf, placePose, restPose, type WorldPose, worldFromLocal } from "../humanoid";

/** Distance of the ghost's hips from the character's, to its right, metres. */
export const BESIDE = 1;
/** Largest drift of the ghost from there, along the character's heading and across it, metres. */
export const MAX_DRIFT = { along: 1.1, across: 0.45 };
/** Share of the drift along the heading by which a ghost is offset in the opposite direction when it is placed again. */
const HEAD_START = 0.5;

/** Maintains the transform from the input's world to the ghost's. */
export class GhostPlacement {
  /** The placed pose. */
  readonly pose = restPose();
  /** Size of the bodies relative to the mannequin; distances scale with it. */
  scale = 1;
  /** Heading to whose right the ghost is; if missing, the character's own. */
  facing: number | undefined;
  readonly #world = createWorldPose();
  #turn = 0;
  #x = 0;
  #z = 0;
  #placed = false;

  /** Chooses a new position with the next pose. */
  reset(): void {
    this.#placed = false;
  }

  /** Places an input pose into {@link pose}. Returns whether the ghost had drifted too far and was placed again. */
  place(input: ArrayLike<number>, proportions: ArrayLike<number>, body: WorldPose, beside: boolean): boolean {
    if (!beside || !this.#placed) {
      this.#anchor(input, proportions, body, beside ? BESIDE * this.scale : 0, 0);
      return false;
    }
    placePose(input, this.#turn, this.#x, this.#z, this.pose);
    const heading = this.facing ?? headingOf(body, 0);
    const [dx, dz] = [this.pose[0]! - body.positions[0]!, this.pose[2]! - body.positions[2]!];
    const along = dx * Math.sin(heading) + dz * Math.cos(heading);
    const right = dz * Math.sin(heading) - dx * Math.cos(heading);
    const { scale } = this;
    const [aside, far, across] = [BESIDE * scale, MAX_DRIFT.along * scale, MAX_DRIFT.across * scale];
    if (Math.abs(along) <= far && Math.abs(right - aside) <= across) return false;
    const drift = Math.max(-far, Math.min(far, along));
    this.#anchor(input, proportions, body, aside, -HEAD_START * drift);
    return true;
  }

  /** Places the ghost's hips `right` metres to the right of the body's and `ahead` metres ahead, with the same heading. */
  #anchor(
    input: ArrayLike<number>,
    proportions: ArrayLike<number>,
    body: WorldPose,
    right: number,
    ahead: number,
  ): void {
    worldFromLocal(proportions, input, this.#world);
    const heading = headingOf(body, 0);
    this.#turn = heading - headingOf(this.#world, heading);
    placePose(input, this.#turn, 0, 0, this.pose);
    const aside = this.facing ?? heading;
    const [s, c] = [Math.sin(aside), Math.cos(aside)];
    this.#x = body.positions[0]! - right * c + ahead * s - this.pose[0]!;
    this.#z = body.positions[2]! + right * s + ahead * c - this.pose[2]!;
    placePose(input, this.#turn, this.#x, this.#z, this.pose);
    this.#placed = true;
  }
}
