/** Several figures at the same instant, each in its own column, seen from the same side by one camera. */

import { Vector3 } from "three";
import { headingOf, isPose, POSE_FLOATS } from "../humanoid";
import { GhostPlacement } from "./ghost_placement";
import { Mannequin } from "./mannequin/mannequin";
import { BodyLook, GhostLook } from "./mannequin/materials";
import type { CameraView } from "./stage/orbit_camera";
import { Redraw } from "./stage/redraw";
import { Stage } from "./stage/stage";
import { THEMES, type ThemeName } from "./themes";

/** One column. */
export interface Figure {
  /** `POSE_FLOATS` numbers. */
  pose: ArrayLike<number>;
  /** A pose that is drawn behind, so that only the difference is visible; `null` draws none. */
  reference: ArrayLike<number> | null;
  /** Draws the pose itself as a ghost of this colour instead of the body. */
  tint?: string;
}

/** Half-life of the distance between a column's camera and its figure, seconds. */
const FOLLOW_HALF_LIFE = 0.12;
/** Beyond this distance the camera jumps, metres. */
const JUMP = 0.6;
/** Below this distance it has arrived, metres. */
const ARRIVED = 1e-4;
/** Space to the left and right of a figure, metres. */
const HALF_WIDTH = 0.62;

/** State of a column. */
interface Column {
  readonly pose: Float32Array;
  readonly reference: Float32Array;
  hasReference: boolean;
  tint: string | undefined;
  /** Offset from the first column's hips to this one's, on the ground; smoothed. */
  x: number;
  z: number;
}

/**
 * A viewer of a row of figures in a container, whose size it follows. One mannequin is posed and drawn for each column
 * in turn, so that a column needs no memory.
 */
export class SideBySideViewer {
  readonly #stage: Stage;
  readonly #body: Mannequin<BodyLook>;
  readonly #reference: Mannequin<GhostLook>;
  readonly #placement = new GhostPlacement();
  #columns: Column[] = [];
  #theme: ThemeName;
  #lastTime: number | undefined;
  readonly #redraw = new Redraw();
  #settled = false;
  /** The colour of the second mannequin; `undefined` for the colour of references. */
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
      this.#redraw.request();
    };
    this.#stage.onIdle = () => this.render(this.#lastTime ?? 0);
    this.#stage.applyQuality();
    this.#applyTheme();
  }

  /** Description of the picture for screen readers. */
  set description(text: string) {
    this.#stage.canvas.setAttribute("aria-label", text);
  }

  /** Light or dark. */
  set theme(theme: ThemeName) {
    if (theme === this.#theme) return;
    this.#theme = theme;
    this.#applyTheme();
  }

  /** Whether there is nothing left to draw. */
  get still(): boolean {
    return this.#stage.still && !this.#redraw.pending;
  }

  /** Sets the bone offsets of all figures: 21 × xyz, metres. */
  setProportions(proportions: ArrayLike<number>): void {
    this.#body.setProportions(proportions);
    this.#reference.setProportions(proportions);
    this.#redraw.request();
  }

  /** Sets the figures from left to right; poses with a number that is not finite are skipped. */
  setFigures(figures: readonly Figure[]): void {
    this.#redraw.request();
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

  /** Moves every camera to its figure at once, after a seek. */
  settle(): void {
    this.#settled = false;
    this.#stage.view.settle();
  }

  /** Moves to a view, with a glide; the side view is from the left, or from the right. */
  camera(view: CameraView, fromRight = false): void {
    this.#body.setPose(this.#columns[0]?.pose ?? this.#body.pose);
    this.#stage.setView(view, headingOf(this.#body.world, 0) + (fromRight ? Math.PI : 0));
    this.#redraw.request();
  }

  /** Draws a frame, unless earlier frames are still being drawn; `timeSecs` is any monotonic clock. */
  render(timeSecs: number): void {
    const dt = Math.max(0, timeSecs - (this.#lastTime ?? timeSecs));
    this.#lastTime = timeSecs;
    const [first] = this.#columns;
    if (!first) return;
    const stage = this.#stage;
    const moved = stage.view.update(dt, hips.set(first.pose[0]!, 0, first.pose[2]!), true);
    const followed = this.#followFigures(first, dt);
    if (moved || followed) this.#redraw.request();
    const still = this.#redraw.settled(timeSecs);
    if ((still && stage.still) || !stage.begin(dt, still)) return;
    this.#redraw.drawn();
    for (const [i, column] of this.#columns.entries()) {
      this.#pose(column);
      stage.view.shift(column.x, column.z);
      stage.render(hips, i);
      stage.view.shift(-column.x, -column.z);
    }
    stage.end();
  }

  /** A copy of the picture; valid only right after {@link render} has drawn it, in the same task. */
  copy(): HTMLCanvasElement {
    return this.#stage.copy();
  }

  /** Frees all resources; the viewer cannot be used afterwards. */
  dispose(): void {
    this.#body.dispose();
    this.#reference.dispose();
    this.#stage.dispose();
  }

  /** Moves every column's camera towards its figure. Returns whether one has not arrived. */
  #followFigures(first: Column, dtSecs: number): boolean {
    const share = this.#settled ? 1 - 0.5 ** (dtSecs / FOLLOW_HALF_LIFE) : 1;
    this.#settled = true;
    let moving = false;
    for (const column of this.#columns) {
      const [x, z] = [column.pose[0]! - first.pose[0]!, column.pose[2]! - first.pose[2]!];
      const away = Math.hypot(x - column.x, z - column.z);
      const step = away > JUMP || away < ARRIVED ? 1 : share;
      column.x += (x - column.x) * step;
      column.z += (z - column.z) * step;
      moving ||= step < 1;
    }
    return moving;
  }

  /** Applies a column's poses to the mannequins and the ground. */
  #pose(column: Column): void {
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
    // The reference is compared with the output, so it has the signal's colour, not the input's.
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
    this.#redraw.request();
  }
}

const hips = new Vector3();
