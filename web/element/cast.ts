/** The character of a player: loaded where its attribute names one, the page's own where the page gave it. */
import type { LoadCharacterOptions } from "../character/load";
import type { CharacterSource } from "../character/read";
import type { Character } from "../character/types";
import type { CallOptions } from "../client/protocol";
import { loadCharacter } from "./host";

/** Where a character comes from: an address, empty for the mannequin, a file, or what `loadCharacter` gave. */
export type CastSource = CharacterSource | Character;

export class Cast {
  /** Asked where the author does not allow everybody to perform a character; without it that is refused. */
  accept: LoadCharacterOptions["accept"];
  readonly #onChange: (character: Character | undefined) => void;
  #character: Character | undefined;
  /** Whether the character was loaded here, and is to be freed. */
  #isOwn = false;
  #loading: AbortController | undefined;

  /** `onChange` is called when another one performs; the one before is freed right after. */
  constructor(onChange: (character: Character | undefined) => void) {
    this.#onChange = onChange;
  }

  /** Who performs; undefined where the mannequin does. */
  get character(): Character | undefined {
    return this.#character;
  }

  /** Takes another character; what performs stays until it is loaded, and where that fails. @throws StrutError */
  async take(source: CastSource, call: CallOptions = {}): Promise<void> {
    this.#loading?.abort();
    const loading = new AbortController();
    this.#loading = loading;
    if (isCharacter(source)) this.#set(source, false);
    else if (source === "") this.#set(undefined, false);
    else {
      const { signal } = loading;
      const accept = this.accept && { accept: this.accept };
      const character = await loadCharacter(source, { ...call, ...accept, signal }).catch((thrown: unknown) => {
        if (!signal.aborted) throw thrown;
      });
      if (signal.aborted) character?.dispose();
      else if (character) this.#set(character, true);
    }
  }

  /** Frees what was loaded; the mannequin performs. */
  dispose(): void {
    this.#loading?.abort();
    this.#set(undefined, false);
  }

  #set(character: Character | undefined, isOwn: boolean): void {
    if (character === this.#character) return;
    const before = this.#isOwn ? this.#character : undefined;
    [this.#character, this.#isOwn] = [character, isOwn];
    this.#onChange(character);
    before?.dispose();
  }
}

function isCharacter(source: CastSource): source is Character {
  return typeof source === "object" && "apply" in source;
}
