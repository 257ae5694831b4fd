/** Who performs in Play: the mannequin, or a character that a person dropped. */
import type { Character, StyledPoses } from "../../character/types";
import { isCancellation } from "../../client/protocol";
import { strings } from "../strings/strings";
import { announce } from "../ui/announce";
import type { ProgressLine } from "../ui/progress";
import type { Toasts } from "../ui/toasts";
import { errorText } from "../ui/words";
import type { Performing } from "../view";
import type { ChosenRoles } from "./open_character";

/** Confidence in the roles below which a person should look at them. */
const SURE = 0.7;

export class Characters {
  readonly #toasts: Toasts;
  readonly #progress: ProgressLine;
  readonly #onChange: () => void;
  #character: Character | undefined;
  #file: File | undefined;
  #performing: Performing | undefined;

  /** `onChange` is called when another body performs; the one before is freed right after. */
  constructor(toasts: Toasts, progress: ProgressLine, onChange: () => void) {
    [this.#toasts, this.#progress, this.#onChange] = [toasts, progress, onChange];
  }

  /** The character that performs; undefined where the mannequin does. */
  get performing(): Performing | undefined {
    return this.#performing;
  }

  /** Opens a file; what performs stays where that fails. */
  async open(file: File): Promise<void> {
    const performing = await this.#open(file);
    if (!performing) return;
    const { performs, unsure } = strings.page.characters;
    if (performing.unsure) this.#toasts.note(unsure(performing.name));
    else announce(performs(performing.name));
  }

  /** Asks which joint of the character is which, and has it perform so. */
  async checkJoints(): Promise<void> {
    if (!this.#character || !this.#file) return;
    const { askForJoints } = await import("./open_character");
    const roles = await askForJoints(this.#character);
    if (roles) await this.#open(this.#file, roles);
  }

  /** Has the mannequin perform again. */
  leave(): void {
    this.#take();
  }

  /** The character's file with a motion; undefined where the mannequin performs. @throws StrutError `licence` */
  glb(motion: StyledPoses): Uint8Array<ArrayBuffer> | undefined {
    return this.#character?.toGLB(motion);
  }

  dispose(): void {
    this.#character?.dispose();
  }

  async #open(file: File, roles?: ChosenRoles): Promise<Performing | undefined> {
    try {
      const character = await this.#progress.run(strings.page.characters.reading(file.name), async (call) => {
        const { openCharacter } = await import("./open_character");
        return openCharacter(file, call, roles);
      });
      this.#toasts.clearErrors();
      this.#take(character, file);
      return this.#performing;
    } catch (error) {
      // A person who does not accept the terms knows why it is not there.
      if (!isCancellation(error) && codeOf(error) !== "licence") this.#toasts.error(errorText(error));
      return undefined;
    }
  }

  #take(character?: Character, file?: File): void {
    const before = this.#character;
    [this.#character, this.#file] = [character, file];
    this.#performing = character && performing(character, file?.name.replace(/\.[^.]*$/, "") ?? "");
    this.#onChange();
    before?.dispose();
  }
}

function performing(performer: Character, fileName: string): Performing {
  const { licence, confidence } = performer;
  const isNamed = licence?.credit && licence.authors.length > 0;
  return {
    name: licence?.title || fileName,
    credit: isNamed ? strings.page.characters.by(licence.authors) : "",
    url: licence?.url,
    unsure: confidence < SURE,
    performer,
  };
}

const codeOf = (error: unknown): unknown => (error as { code?: unknown }).code;
