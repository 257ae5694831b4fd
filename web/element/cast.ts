/** The character of a player: loaded from its attribute, or an object given by the page. */
import type { LoadCharacterOptions } from "../character/load";
import type { CharacterSource } from "../character/read";
import type { Character } from "../character/types";
import type { CallOptions } from "../client/protocol";
import { loadCharacter } from "./host";

/** Source of a character: a URL, empty for the mannequin, a file, or a result of `loadCharacter`. */
export type CastSource = CharacterSource | Character;

/** Time out of sight after which a character is freed, milliseconds. */
const UNSEEN_MS = 30_000;

export class Cast {
  /** Asked if the author does not allow everyone to perform a character; without it the character is refused. */
  accept: LoadCharacterOptions["accept"];
  readonly #onChange: (character: Character | undefined) => void;
  #character: Character | undefined;
  /** Whether the character was loaded here, and must be freed. */
  #isOwn = false;
  #loading: AbortController | undefined;
  #unseen: ReturnType<typeof setTimeout> | undefined;
  #isFreed = false;

  /** `onChange` is called when another character performs; the previous one is freed right after. */
  constructor(onChange: (character: Character | undefined) => void) {
    this.#onChange = onChange;
  }

  /** The character in use; `undefined` for the mannequin. */
  get character(): Character | undefined {
    return this.#character;
  }

  /** Changes the character; the current one stays until the new one is loaded, and if loading fails. @throws StrutError */
  async take(source: CastSource, call: CallOptions = {}): Promise<void> {
    this.#isFreed = false;
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

  /** Whether the character was freed because it was out of sight: it must be taken again. */
  get isFreed(): boolean {
    return this.#isFreed;
  }

  /** Frees a character that stays out of sight. */
  set isVisible(isVisible: boolean) {
    clearTimeout(this.#unseen);
    if (isVisible || !this.#character) return;
    this.#unseen = setTimeout(() => {
      this.#isFreed = true;
      this.dispose();
    }, UNSEEN_MS);
  }

  /** Frees the loaded character; the mannequin performs. */
  dispose(): void {
    clearTimeout(this.#unseen);
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
