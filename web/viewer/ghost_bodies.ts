/** Any number of translucent bodies at the positions of their poses. */
import { Group } from "three";
import { Mannequin } from "./mannequin/mannequin";
import { GhostLook } from "./mannequin/materials";
import type { Theme } from "./themes";

/** A translucent body. */
export interface GhostBody {
  /** `POSE_FLOATS` numbers; the array is not kept. */
  pose: ArrayLike<number>;
  /** Its opacity as a share of a ghost's, 0 to 1. */
  share: number;
}

export class GhostBodies {
  readonly object = new Group();
  readonly #bodies: Mannequin<GhostLook>[] = [];
  #theme: Theme;
  #proportions: ArrayLike<number>;
  #detail: number;

  constructor(theme: Theme, proportions: ArrayLike<number>, detail: number) {
    this.#theme = theme;
    this.#proportions = proportions;
    this.#detail = detail;
  }

  /** Sets all bodies. Unused mannequins are kept invisible. */
  set(ghosts: readonly GhostBody[]): void {
    while (this.#bodies.length < ghosts.length) this.#add();
    for (const [i, body] of this.#bodies.entries()) {
      const ghost = ghosts[i];
      body.object.visible = ghost !== undefined && ghost.share > 0;
      if (!ghost) continue;
      body.look.fade = ghost.share;
      body.setPose(ghost.pose);
    }
  }

  /** Examples are drawn in the colour of weights. */
  setTheme(theme: Theme): void {
    this.#theme = theme;
    for (const body of this.#bodies) this.#paint(body);
  }

  setProportions(proportions: ArrayLike<number>): void {
    this.#proportions = proportions;
    for (const body of this.#bodies) body.setProportions(proportions);
  }

  setDetail(detail: number): void {
    this.#detail = detail;
    for (const body of this.#bodies) body.setDetail(detail);
  }

  dispose(): void {
    this.object.removeFromParent();
    for (const body of this.#bodies) body.dispose();
  }

  #add(): void {
    const body = new Mannequin((uniforms) => new GhostLook(uniforms), this.#detail);
    // Ghosts never cover the character itself.
    body.look.behindBodies = true;
    body.setProportions(this.#proportions);
    this.#paint(body);
    this.#bodies.push(body);
    this.object.add(body.object);
  }

  #paint(body: Mannequin<GhostLook>): void {
    const { weight, ghost } = this.#theme;
    body.look.setTheme({ ...this.#theme, ghost: { body: weight, rim: weight, opacity: ghost.opacity } });
  }
}
