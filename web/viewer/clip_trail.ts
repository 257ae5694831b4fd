/** Overlays of the performed clip: the path of the hips, and the motion trail before and after the current frame. */
import { MathUtils } from "three";
import { hipsTurn, POSE_FLOATS } from "../humanoid";
import { OnionSkin } from "./onion_skin";
import { MotionTrail } from "./stage/motion_trail";
import type { Stage } from "./stage/stage";
import type { Theme } from "./themes";

/** The motion trail: none, lines of hands, feet and head, or whole bodies as well. */
export type MotionTrailMode = "off" | "lines" | "onion";

/** How the bodies of other moments look. */
interface Bodies {
  theme: Theme;
  bones: ArrayLike<number>;
  detail: number;
}

export class ClipTrail {
  readonly #stage: Stage;
  readonly #lines = new MotionTrail();
  #onion: OnionSkin | undefined;
  #mode: MotionTrailMode = "off";
  #clip: Float32Array | null = null;
  /** Fractional frame of the clip that is displayed. */
  frame = 0;

  constructor(stage: Stage) {
    this.#stage = stage;
    stage.scene.add(this.#lines.object);
  }

  get mode(): MotionTrailMode {
    return this.#mode;
  }

  setMode(mode: MotionTrailMode, { theme, bones, detail }: Bodies): void {
    this.#mode = mode;
    this.#lines.object.visible = mode !== "off";
    this.#onion?.dispose();
    this.#onion = undefined;
    if (mode !== "onion") return;
    this.#onion = new OnionSkin(theme, bones, detail);
    this.#stage.scene.add(this.#onion.object);
    void this.#stage.compile();
  }

  /** Sets the clip on the body that performs it, with the bones of that body; `null` for none. */
  setClip(clip: Float32Array | null, proportions: ArrayLike<number>): void {
    this.#clip = clip;
    this.#stage.path.setClip(clip);
    this.#lines.setClip(clip, proportions);
  }

  setProportions(bones: ArrayLike<number>): void {
    this.#onion?.setProportions(bones);
  }

  setDetail(detail: number): void {
    this.#onion?.setDetail(detail);
  }

  setTheme(theme: Theme): void {
    this.#lines.setTheme(theme);
    this.#onion?.setTheme(theme);
  }

  /** Rotation from the clip's heading at its frame to that of a pose. */
  turnTo(pose: ArrayLike<number>): number {
    const clip = this.#clip;
    if (!clip) return 0;
    const frame = MathUtils.clamp(Math.round(this.frame), 0, clip.length / POSE_FLOATS - 1);
    return hipsTurn(pose) - hipsTurn(clip, frame);
  }

  /** Draws the moments before and after the current frame of a character with its hips at a point of the ground. */
  draw(pose: ArrayLike<number>, hips: { x: number; z: number }): void {
    const clip = this.#clip;
    if (this.#mode === "off" || !clip) return;
    const turn = this.turnTo(pose);
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    const frames = clip.length / POSE_FLOATS;
    const at = MathUtils.clamp(this.frame, 0, frames - 1);
    const [i, t] = [Math.floor(at), at - Math.floor(at)];
    const root = (axis: 0 | 2) => {
      const a = clip[i * POSE_FLOATS + axis]!;
      return a + (clip[Math.min(i + 1, frames - 1) * POSE_FLOATS + axis]! - a) * t;
    };
    const [x, z] = [root(0), root(2)];
    const placement = { turn, x: hips.x - c * x - s * z, z: hips.z - c * z + s * x };
    this.#lines.draw(this.frame, placement);
    this.#onion?.place(clip, this.frame, placement);
  }

  dispose(): void {
    this.#lines.dispose();
    this.#onion?.dispose();
  }
}
