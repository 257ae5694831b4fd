/** Title and caption over the picture: the recognised action and the styles. */
import type { Reading } from "../../../client/protocol";
import type { Session } from "../../../player/session";
import type { Playhead } from "../../state/playhead";
import type { Store } from "../../state/store";
import { ownParts, stylesAt } from "../../state/style_settings";
import { strings } from "../../strings/strings";
import { inputTitle, stageCaption, stageTitle } from "../../ui/words";
import type { Likeness } from "./likeness";
import { ReadAction } from "./read_action";
import type { ViewportPanel } from "./viewport_panel";

/** Minimum time between updates along a style track, so that the title can be read. */
const FOLLOW_MS = 300;

export class Heading {
  readonly #store: Store;
  readonly #session: Session;
  readonly #playhead: Playhead;
  readonly #viewport: ViewportPanel;
  readonly #action = new ReadAction();
  #shownAt = 0;

  constructor(store: Store, session: Session, playhead: Playhead, viewport: ViewportPanel) {
    this.#store = store;
    this.#session = session;
    this.#playhead = playhead;
    this.#viewport = viewport;
  }

  /** Updates from the classes of a new frame, heaviest first. */
  take(reads: readonly Reading[]): void {
    const passing = this.#store.state.track.length > 1 && performance.now() - this.#shownAt > FOLLOW_MS;
    if (this.#action.take(reads) || passing) this.show();
  }

  /** Called when another input is open. */
  forget(): void {
    this.#action.forget();
    this.show();
  }

  /** Sets the recognised class of the whole input. */
  takeWhole(likeness: Likeness): void {
    if (this.#action.takeWhole(likeness)) this.show();
  }

  /** Updates title and caption. */
  show(): void {
    const session = this.#session;
    this.#shownAt = performance.now();
    if (!session.database) return;
    const { intensity, track } = this.#store.state;
    const { state } = this.#store;
    const styles = session.endless ? state.styles : stylesAt(state, this.#playhead.at);
    const { neutral, rateHz } = session.database;
    this.#viewport.heading = {
      title: stageTitle(session.drive ? strings.play.driving : this.#action.name, styles, intensity, neutral),
      caption: stageCaption(
        inputTitle(session.library, session.chosen),
        {
          styles: styles.filter((s) => s.weight !== 0).length,
          parts: ownParts(this.#store.state).length,
          keys: session.endless ? 0 : track.length,
        },
        rateHz,
        session.databaseSource?.kind === "strutdb" ? session.databaseSource.name.replace(/\.strutdb$/i, "") : "",
      ),
    };
  }
}
