/** The title over the picture: what the character is read to do, and in which styles. */
import type { Reading } from "../worker/protocol";
import type { Playhead } from "./playhead";
import { ReadAction } from "./read_action";
import type { Session } from "./session";
import type { Stage } from "./stage";
import type { Store } from "./store";
import { ownParts, stylesAt } from "./style_settings";
import { stageCaption, stageTitle } from "./words";

/** The title follows a style track this often, so that it can be read. */
const FOLLOW_MS = 300;

export class Heading {
  session: Session | undefined;
  readonly #store: Store;
  readonly #stage: Stage;
  readonly #playhead: Playhead;
  readonly #action = new ReadAction();
  #shownAt = 0;

  constructor(store: Store, stage: Stage, playhead: Playhead) {
    this.#store = store;
    this.#stage = stage;
    this.#playhead = playhead;
  }

  /** Takes the classes of a new frame, heaviest first. */
  take(reads: readonly Reading[]): void {
    const passing = this.#store.state.track.length > 1 && performance.now() - this.#shownAt > FOLLOW_MS;
    if (this.#action.take(reads) || passing) this.show();
  }

  /** Says what is so now. */
  show(): void {
    const { session } = this;
    this.#shownAt = performance.now();
    if (!session?.database) return;
    const { intensity, track } = this.#store.state;
    const styles = stylesAt(this.#store.state, this.#playhead.at);
    const { neutral, rateHz } = session.database;
    this.#stage.heading = {
      title: stageTitle(this.#action.name, styles, intensity, neutral),
      caption: stageCaption(
        session.library.title(session.inputName),
        {
          styles: styles.filter((s) => s.weight !== 0).length,
          parts: ownParts(this.#store.state).length,
          keys: track.length,
        },
        rateHz,
      ),
    };
  }
}
