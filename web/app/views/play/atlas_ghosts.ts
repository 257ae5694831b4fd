/** A window of the atlas as a ghost: at the character's left, oriented relative to it as the window is to the input. */
import type { LiveFrame } from "../../../client/protocol";
import { hipsTurn, placePose, restPose } from "../../../humanoid";
import type { Playhead } from "../../state/playhead";
import type { Store } from "../../state/store";
import type { AtlasGhost } from "./atlas/atlas_pane";
import type { ViewportPanel } from "./viewport_panel";

/** Distance of the ghost's hips from the character's, to its left, metres; the input's ghost is at its right. */
const BESIDE = 1;
/** Distance of the playhead at which the ghost disappears, frames. */
const AWAY = 0.75;

export class AtlasGhosts {
  readonly #pose = restPose();
  #ghost: AtlasGhost | undefined;
  #isShown = false;

  constructor(
    private readonly store: Store,
    private readonly playhead: Playhead,
    private readonly viewport: ViewportPanel,
  ) {}

  /** Moves to the ghost's frame and shows the ghost there; `undefined` removes it. */
  show(ghost: AtlasGhost | undefined): void {
    this.#hide();
    this.#ghost = ghost;
    if (!ghost) return;
    this.store.edit({ playing: false });
    this.playhead.goTo(ghost.frame);
  }

  /** Follows the displayed frame: the ghost is shown at its own frame only. */
  follow(frame: LiveFrame): void {
    const ghost = this.#ghost;
    if (!ghost) return;
    if (Math.abs(frame.inputFrame - ghost.frame) > AWAY) {
      if (this.#isShown) this.show(undefined);
      return;
    }
    const turn = hipsTurn(frame.pose) - hipsTurn(frame.inputPose);
    placePose(frame.inputPose, turn, 0, 0, this.#pose);
    const heading = hipsTurn(frame.pose);
    const [dx, dz] = [frame.pose[0]! - this.#pose[0]!, frame.pose[2]! - this.#pose[2]!];
    placePose(ghost.pose, turn, dx + BESIDE * Math.cos(heading), dz - BESIDE * Math.sin(heading), this.#pose);
    this.viewport.other = this.#pose;
    this.#isShown = true;
  }

  #hide(): void {
    if (this.#isShown) this.viewport.other = undefined;
    this.#isShown = false;
  }
}
