/** The translucent mannequin that performs the input, at the character's side or at its position. */
import { Vector3 } from "three";
import { restPose, type WorldPose } from "../humanoid";
import { GhostPlacement } from "./ghost_placement";
import { Mannequin } from "./mannequin/mannequin";
import { GhostLook } from "./mannequin/materials";
import { type Redraw, setPose } from "./stage/redraw";

/** Position of the input's ghost: at the character's right, at the character's position and behind it, or none. */
export type GhostMode = "beside" | "overlay" | "off";

/** Duration of its fade-in after it was placed again, seconds. */
const FADE_IN = 0.25;

export class Ghost {
  readonly body: Mannequin<GhostLook>;
  /** The input's pose. */
  readonly input = restPose();
  /** Position of its hips in the picture's world, metres. */
  readonly hips = new Vector3();
  /** Whether it is at the right of the picture instead of at the character's right. */
  byCamera = false;
  readonly #placement = new GhostPlacement();
  #mode: GhostMode;
  #hasInput = false;
  #fade = 1;

  constructor(mode: GhostMode, detail: number) {
    this.#mode = mode;
    this.body = new Mannequin((uniforms) => new GhostLook(uniforms), detail);
    this.#apply();
  }

  get mode(): GhostMode {
    return this.#mode;
  }

  set mode(mode: GhostMode) {
    this.#mode = mode;
    this.#apply();
  }

  get isVisible(): boolean {
    return this.body.object.visible;
  }

  /** Whether it is visible at the character's side. */
  get isBeside(): boolean {
    return this.#hasInput && this.#mode === "beside";
  }

  /** Size of the character that performs, relative to the mannequin. */
  set scale(scale: number) {
    this.#placement.scale = scale;
  }

  /** Sets the input's pose, or `null` if there is none. Returns whether the ghost appeared or disappeared. */
  setInput(pose: ArrayLike<number> | null, redraw: Redraw): boolean {
    if (pose) setPose(this.input, pose, redraw);
    const has = pose !== null;
    if (has === this.#hasInput) return false;
    this.#hasInput = has;
    this.#apply();
    return true;
  }

  /** Places it again at the next {@link place}. */
  reset(): void {
    this.#placement.reset();
  }

  /**
   * Moves it to its place.
   * @param input the input's pose on the body that performs
   * @param world the character's joints
   * @param azimuth direction of the camera, radians
   */
  place(input: ArrayLike<number>, world: WorldPose, azimuth: number): void {
    this.#placement.facing = this.byCamera ? azimuth + Math.PI : undefined;
    const again = this.#placement.place(input, this.body.fit.proportions, world, this.#mode === "beside");
    if (again) this.#fade = 0;
    this.body.setPose(this.#placement.pose);
    this.hips.fromArray(this.body.world.positions, 0);
  }

  fadeIn(dtSecs: number): void {
    if (this.#fade >= 1) return;
    this.#fade = Math.min(1, this.#fade + dtSecs / FADE_IN);
    this.body.look.fade = this.#fade;
  }

  #apply(): void {
    const mode = this.#hasInput ? this.#mode : "off";
    this.body.object.visible = mode !== "off";
    this.body.look.behindBodies = mode === "overlay";
    this.#placement.reset();
  }
}
