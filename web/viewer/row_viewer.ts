/** Several figures at the same instant, each in a column of its own, seen from the same side by one camera. */

import { Vector3 } from "three";
import { GhostPlacement } from "./ghost_placement";
import { headingOf, isPose, POSE_FLOATS } from "./humanoid";
import { Mannequin } from "./mannequin/mannequin";
import { BodyLook, GhostLook } from "./mannequin/materials";
import type { CameraView } from "./stage/orbit_camera";
import { Stage } from "./stage/stage";
import { THEMES, type ThemeName } from "./themes";

/** One column. */
export interface Figure {
  /** `POSE_FLOATS` numbers. */
  pose: ArrayLike<number>;
  /** A pose that is drawn behind, so that only what differs shows; `null` draws none. */
  reference: ArrayLike<number> | null;
  /** Draws the pose itself as a ghost of this colour instead of the body. */
  tint?: string;
}

/** Time after the last change in which glides end, seconds; then the picture is still. */
const SETTLING = 0.8;
/** Time in which a column's camera covers half the distance to its figure, seconds. */
const FOLLOW_HALF_LIFE = 0.12;
/** Farther than this the camera jumps, metres. */
const JUMP = 0.6;
/** Room left and right of a figure, metres. */
const HALF_WIDTH = 0.62;

/** What a column remembers. */
interface Column {
  readonly pose: Float32Array;
  readonly reference: Float32Array;
  hasReference: boolean;
  tint: string | undefined;
  /** From the first column's hips to this one's, on the ground; smoothed. */
  x: number;
  z: number;
}

/**
 * A viewer of a row of figures in a container, whose size it follows. One mannequin performs all of them, one after the
 * other, so that a column costs no memory.
 */
export class RowViewer {
  readonly #stage: Stage;
  readonly #body: Mannequin<BodyLook>;
  readonly #reference: Mannequin<GhostLook>;
  readonly #placement = new GhostPlacement();
  #columns: Column[] = [];
  #theme: ThemeName;
  #lastTime: number | undefined;
  #changedAt = 0;
  #changed = true;
  #settled = false;
  /** The colour that the second mannequin has; `undefined` for that of references. */
  #tint: string | undefined;

  constructor(container: HTMLElement, theme: ThemeName, description: string) {
    this.#theme = theme;
    this.#stage = new Stage(container);
    this.#stage.canvas.setAttribute("aria-label", description);
    this.#stage.view.halfWidth = HALF_WIDTH;
    const { detail, shading } = this.#stage.quality;
    this.#body = new Mannequin((uniforms) => new BodyLook(uniforms, shading), detail);
    this.#reference = new Mannequin((uniforms) => new GhostLook(uniforms), detail);
    this.#reference.look.behindBodies = true;
    this.#stage.scene.add(this.#body.object, this.#reference.object);
    this.#stage.onQuality = ({ taps, detail, shading }) => {
      this.#body.look.setQuality(shading, taps);
      this.#body.setDetail(detail);
      this.#reference.setDetail(detail);
    };
    this.#stage.onInvalid = () => {
      this.#changed = true;
    };
    this.#stage.onIdle = () => this.render(this.#lastTime ?? 0);
    this.#stage.applyQuality();
    this.#applyTheme();
  }

  /** What a screen reader says of the picture. */
  set description(text: string) {
    this.#stage.canvas.setAttribute("aria-label", text);
  }

  /** Light or dark. */
  set theme(theme: ThemeName) {
    if (theme === this.#theme) return;
    this.#theme = theme;
    this.#applyTheme();
  }

  /** Whether nothing is left to draw. */
  get still(): boolean {
    return this.#stage.still && !this.#changed;
  }

  /** Takes the bone offsets of all figures: 21 × xyz, metres. */
  setProportions(proportions: ArrayLike<number>): void {
    this.#body.setProportions(proportions);
    this.#reference.setProportions(proportions);
    this.#changed = true;
  }

  /** Takes the figures from left to right; poses with a number that is not finite are passed over. */
  setFigures(figures: readonly Figure[]): void {
    this.#changed = true;
    while (this.#columns.length > figures.length) this.#columns.pop();
    while (this.#columns.length < figures.length) {
      const empty = { hasReference: false, tint: undefined, x: 0, z: 0 };
      this.#columns.push({ pose: new Float32Array(POSE_FLOATS), reference: new Float32Array(POSE_FLOATS), ...empty });
      this.#settled = false;
    }
    this.#stage.columns = Math.max(1, figures.length);
    for (const [i, { pose, reference, tint }] of figures.entries()) {
      const column = this.#columns[i]!;
      if (isPose(pose)) column.pose.set(pose);
      column.tint = tint;
      column.hasReference = reference !== null && isPose(reference);
      if (column.hasReference) column.reference.set(reference!);
    }
  }

  /** Sets every camera on its figure anew: after a seek. */
  settle(): void {
    this.#settled = false;
    this.#stage.view.settle();
  }

  /** Goes to a view, gliding; that from the side is from the left, or from the right. */
  camera(view: CameraView, fromRight = false): void {
    this.#body.setPose(this.#columns[0]?.pose ?? this.#body.pose);
    this.#stage.setView(view, headingOf(this.#body.world, 0) + (fromRight ? Math.PI : 0));
    this.#changed = true;
  }

  /** Draws a frame, unless those before are still being drawn; `timeSecs` is any clock that does not run backwards. */
  render(timeSecs: number): void {
    const dt = Math.max(0, timeSecs - (this.#lastTime ?? timeSecs));
    this.#lastTime = timeSecs;
    const [first] = this.#columns;
    if (!first) return;
    const stage = this.#stage;
    const moved = stage.view.update(dt, hips.set(first.pose[0]!, 0, first.pose[2]!), true);
    if (this.#changed || moved) this.#changedAt = timeSecs;
    this.#changed = false;
    const still = timeSecs - this.#changedAt > SETTLING;
    if (still && stage.still) return;
    const share = this.#settled ? 1 - 0.5 ** (dt / FOLLOW_HALF_LIFE) : 1;
    this.#settled = true;
    for (const column of this.#columns) {
      const [x, z] = [column.pose[0]! - first.pose[0]!, column.pose[2]! - first.pose[2]!];
      const far = Math.hypot(x - column.x, z - column.z) > JUMP;
      column.x += (x - column.x) * (far ? 1 : share);
      column.z += (z - column.z) * (far ? 1 : share);
    }
    if (!stage.begin(dt, still)) return;
    for (const [i, column] of this.#columns.entries()) {
      this.#perform(column);
      stage.view.shift(column.x, column.z);
      stage.render(hips, i);
      stage.view.shift(-column.x, -column.z);
    }
    stage.end();
  }

  /** A copy of the picture; only right after {@link render} has drawn it, in the same task. */
  copy(): HTMLCanvasElement {
    return this.#stage.copy();
  }

  /** Frees everything; the viewer cannot be used afterwards. */
  dispose(): void {
    this.#body.dispose();
    this.#reference.dispose();
    this.#stage.dispose();
  }

  /** Brings the mannequins and the ground to a column's poses. */
  #perform(column: Column): void {
    const { world, fit } = this.#body;
    this.#body.setPose(column.pose);
    hips.fromArray(world.positions, 0);
    this.#stage.shade.setOccluder("body", world, fit.stature);
    this.#body.object.visible = column.tint === undefined;
    this.#reference.object.visible = column.hasReference || column.tint !== undefined;
    this.#reference.look.behindBodies = column.tint === undefined;
    if (this.#tint !== column.tint) this.#tintReference(column.tint);
    if (column.tint !== undefined) this.#reference.setPose(column.pose);
    if (!column.hasReference) return;
    this.#placement.place(column.reference, this.#reference.fit.proportions, world, false);
    this.#reference.setPose(this.#placement.pose);
  }

  #tintReference(tint: string | undefined): void {
    this.#tint = tint;
    const theme = THEMES[this.#theme];
    // What differs is what was chosen: it has the signal's colour, not the input's.
    const colour = tint ?? theme.signal;
    this.#reference.look.setTheme({ ...theme, ghost: { body: colour, rim: colour, opacity: 0.34 } });
  }

  #applyTheme(): void {
    const theme = THEMES[this.#theme];
    this.#body.look.setTheme(theme);
    this.#tintReference(undefined);
    // Columns stand side by side without a seam.
    const { inner } = theme.background;
    this.#stage.setTheme({ ...theme, background: { inner, outer: inner } });
    this.#changed = true;
  }
}

const hips = new Vector3();
