/** The character before and after the current moment, as ghosts that fade with their distance in time. */

import { Group } from "three";
import { POSE_FLOATS, placePose, restPose } from "../humanoid";
import { Mannequin } from "./mannequin/mannequin";
import { GhostLook } from "./mannequin/materials";
import type { Placement } from "./stage/motion_trail";
import type { Theme } from "./themes";

/** Frames between two skins: a fifth of a second at 60 Hz. */
const STEP = 12;
/** Offset of each skin from the current frame, in steps, and its opacity as a share of the ghost's. */
const SKINS = [
  { steps: -2, fade: 0.3 },
  { steps: -1, fade: 0.6 },
  { steps: 1, fade: 0.45 },
  { steps: 2, fade: 0.22 },
] as const;

export class OnionSkin {
  readonly object = new Group();
  readonly #skins: Mannequin<GhostLook>[];
  readonly #pose = restPose();

  constructor(theme: Theme, proportions: ArrayLike<number>, detail: number) {
    this.#skins = SKINS.map(({ fade }) => {
      const skin = new Mannequin((uniforms) => new GhostLook(uniforms), detail);
      skin.look.fade = fade;
      // Skins never cover the character itself.
      skin.look.behindBodies = true;
      skin.setProportions(proportions);
      this.object.add(skin.object);
      return skin;
    });
    this.setTheme(theme);
  }

  /** The skins show the output, so they have its colour. */
  setTheme(theme: Theme): void {
    const ghost = { body: theme.signal, rim: theme.signal, opacity: theme.ghost.opacity };
    for (const skin of this.#skins) skin.look.setTheme({ ...theme, ghost });
  }

  setProportions(proportions: ArrayLike<number>): void {
    for (const skin of this.#skins) skin.setProportions(proportions);
  }

  setDetail(detail: number): void {
    for (const skin of this.#skins) skin.setDetail(detail);
  }

  /** Shows the skins around a frame of a clip; skins beyond its ends are not drawn. */
  place(clip: Float32Array | null, frame: number, { turn, x, z }: Placement): void {
    const frames = clip ? clip.length / POSE_FLOATS : 0;
    for (const [i, { steps }] of SKINS.entries()) {
      const skin = this.#skins[i]!;
      const at = Math.round(frame) + steps * STEP;
      skin.object.visible = at >= 0 && at < frames;
      if (!skin.object.visible) continue;
      placePose(clip!.subarray(at * POSE_FLOATS, (at + 1) * POSE_FLOATS), turn, x, z, this.#pose);
      skin.setPose(this.#pose);
    }
  }

  dispose(): void {
    this.object.removeFromParent();
    for (const skin of this.#skins) skin.dispose();
  }
}
