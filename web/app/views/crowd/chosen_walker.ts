/** The selected walker: its card is open, and the camera may follow it. */

import type { Crowd, CrowdTick } from "../../../client/crowd/crowd_client";
import type { FieldVertex } from "../../../client/crowd/limits";
import { normalised, TRIANGLE } from "../../../ui/polygon/selection";
import type { CrowdKind } from "../../state/crowd";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { WalkerCard } from "./walker_card";
import { asWalkBlock, Strides, sharesOf } from "./walker_facts";

const words = strings.crowd;

/** All agents at the current tick. */
export interface Walking {
  kind: CrowdKind;
  crowd: Crowd;
  tick: CrowdTick;
  field: readonly FieldVertex[];
}

export class ChosenWalker {
  readonly #store: Store;
  readonly #card: WalkerCard;
  readonly #strides = new Strides();
  #walking: Walking | undefined;

  /** @param save waits for a file, and reports the result */
  constructor(store: Store, save: (saving: Promise<string>) => Promise<void>) {
    this.#store = store;
    this.#card = new WalkerCard({
      onFollow: () => this.toggleFollow(),
      onExport: () => void this.#export(save),
      onOpen: () => this.#openElsewhere(),
      onClose: () => this.choose(undefined),
    });
  }

  get card(): HTMLElement {
    return this.#card.element;
  }

  /** Index of the selected walker; `undefined` if there is none, or there are fewer agents. */
  get number(): number | undefined {
    const { crowdWalker } = this.#store.state;
    return crowdWalker >= 0 && crowdWalker < (this.#walking?.tick.count ?? 0) ? crowdWalker : undefined;
  }

  choose(walker: number | undefined): void {
    const leaves = walker === undefined || walker !== this.#store.state.crowdWalker;
    this.#store.edit({ crowdWalker: walker ?? -1, ...(leaves && { crowdFollow: false }) });
  }

  /** Selects the next walker, or the previous one. */
  chooseNext(by: 1 | -1): void {
    const count = this.#walking?.tick.count ?? 0;
    if (count === 0) return;
    const from = this.number ?? (by > 0 ? -1 : count);
    this.#store.edit({ crowdWalker: (from + by + count) % count });
  }

  toggleFollow(): void {
    if (this.number !== undefined) this.#store.edit({ crowdFollow: !this.#store.state.crowdFollow });
  }

  /** Sets all agents after a tick; `undefined` without a crowd. */
  take(walking: Walking | undefined): void {
    this.#walking = walking;
    const { number } = this;
    if (walking && number !== undefined) this.#strides.add(walking.tick, number);
    else this.#strides.forget();
  }

  /** Shows the card, or hides it. */
  show(): void {
    const [walking, walker] = [this.#walking, this.number];
    this.#card.show(
      walking && walker !== undefined
        ? {
            kind: walking.kind,
            walker,
            speed: this.#strides.speed(walker, walking.crowd.rateHz),
            shares: sharesOf(walking.tick, walker, walking.crowd.styles, walking.field, words.of[walking.kind].rest),
            follows: this.#store.state.crowdFollow,
          }
        : undefined,
    );
  }

  async #export(save: (saving: Promise<string>) => Promise<void>): Promise<void> {
    const [walking, walker] = [this.#walking, this.number];
    if (!walking || walker === undefined) return;
    this.#card.exporting = true;
    await save(
      import("./crowd_outputs").then(({ saveWalker }) =>
        saveWalker(walking.crowd, walker, words.of[walking.kind].one(walker + 1)),
      ),
    );
    this.#card.exporting = false;
  }

  /** Opens the Walk view with a plan of the walker's styles, or Play with the styles in which it performs. */
  #openElsewhere(): void {
    const [walking, walker] = [this.#walking, this.number];
    if (!walking || walker === undefined) return;
    const block = asWalkBlock(walking.tick, walker, walking.crowd.styles);
    if (walking.kind === "performers") {
      const styles = block.styles.toSorted((a, b) => b.weight - a.weight).slice(0, TRIANGLE);
      this.#store.edit({ view: "play", styles: normalised(styles), intensity: block.intensity, parts: {}, track: [] });
    } else this.#store.edit({ view: "walk", walk: [block], walkBlock: 0, walkWhole: true });
  }
}
