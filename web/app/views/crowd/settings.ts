/** The settings of the state, made valid for a crowd: invalid values of a link are reported, and the previous ones stay. */

import type { FieldVertex, Place } from "../../../client/crowd/limits";
import { type CrowdKind, type People, Refused } from "../../state/crowd";
import { initialState } from "../../state/state";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { spoken } from "../../ui/words";
import { firstField, unknownStyle } from "./field";

const words = strings.crowd;

/** Settings of a crowd. */
interface CrowdSettings {
  kind: CrowdKind;
  people: People;
  field: readonly FieldVertex[];
  route: readonly Place[];
}

/** Styles of a model and the neutral one; none until a model is open. */
export interface Styles {
  all: readonly string[];
  neutral: string;
}

export class Settings {
  readonly #store: Store;
  readonly #onRefused: (sentence: string) => void;
  #kind: CrowdKind = "walkers";
  #people: People = initialState().crowd as People;
  #field: readonly FieldVertex[] | undefined;
  #route: readonly Place[] = [];

  constructor(store: Store, onRefused: (sentence: string) => void) {
    this.#store = store;
    this.#onRefused = onRefused;
  }

  /** The settings of the state for a model with these styles. Invalid values are reported, and removed from the state. */
  read(styles: Styles | undefined): CrowdSettings {
    const { crowdKind, crowd, field, route } = this.#store.state;
    this.#kind = this.#accept(crowdKind, this.#kind, (kept) => ({ crowdKind: kept }));
    this.#people = this.#accept(crowd, this.#people, (people) => ({ crowd: people }));
    this.#route = this.#accept(route, this.#route, (kept) => ({ route: kept }));
    const asked = this.#accept(field, this.#field, (kept) => ({ field: kept }));
    this.#field = styles ? this.#known(asked, styles) : asked;
    return { kind: this.#kind, people: this.#people, field: this.#field ?? [], route: this.#route };
  }

  #accept<T>(value: T | Refused, kept: T, patch: (kept: T) => Parameters<Store["adopt"]>[0]): T {
    if (!(value instanceof Refused)) return value;
    this.#onRefused(words.refused[value.why](shortened(value.text)));
    this.#store.adopt(patch(kept));
    return kept;
  }

  /** The field with styles of the model only; the default field if none is chosen. */
  #known(asked: readonly FieldVertex[] | undefined, { all, neutral }: Styles): readonly FieldVertex[] {
    if (!asked) return this.#adopted(firstField(all, neutral));
    const unknown = unknownStyle(asked, all);
    if (unknown === undefined) return asked;
    this.#onRefused(words.noStyle(shortened(spoken(unknown)), all.map(spoken).join(", ")));
    const before = this.#field?.filter(({ style }) => all.includes(style)) ?? [];
    return this.#adopted(before.length > 0 ? before : firstField(all, neutral));
  }

  #adopted(field: readonly FieldVertex[]): readonly FieldVertex[] {
    this.#field = field;
    this.#store.adopt({ field });
    return field;
  }
}

/** A link's text, cut to fit into a sentence. */
function shortened(text: string): string {
  return text.length > 40 ? `${text.slice(0, 40)}…` : text;
}
