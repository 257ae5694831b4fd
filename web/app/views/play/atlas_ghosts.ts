/** A window of the atlas as a ghost: at the character's left, turned to it as the window is to the input. */
import type { LiveFrame } from "../../../client/protocol";
import { hipsTurn, placePose, restPose } from "../../../humanoid";
import type { Playhead } from "../../state/playhead";
import type { Store } from "../../state/store";
import type { AtlasGhost } from "./atlas/atlas_pane";
import type { ViewportPanel } from "./viewport_panel";

/** Distance of the ghost's hips from the character's, to its left, metres; the input's ghost is at its right. */
const BESIDE = 1;
/** Frames that the playhead is away before the ghost goes. */
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

  /** Goes to the ghost's frame and shows it there; `undefined` takes it away. */
  show(ghost: AtlasGhost | undefined): void {
    this.#hide();
    this.#ghost = ghost;
    if (!ghost) return;
    this.store.edit({ playing: false });
    this.playhead.goTo(ghost.frame);
  }

  /** Takes the frame that is on screen: the ghost stays for its own. */
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
