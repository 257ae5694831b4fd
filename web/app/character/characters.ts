/** The character in Play: the mannequin, or a dropped character. */
import type { Character, StyledPoses } from "../../character/types";
import type { DroppedFile } from "../../client/build/protocol";
import { type CallOptions, isCancellation } from "../../client/protocol";
import { strings } from "../strings/strings";
import { announce } from "../ui/announce";
import type { ProgressLine } from "../ui/progress";
import type { Toasts } from "../ui/toasts";
import type { Performing } from "../view";
import type { ChosenRoles, Content } from "./open_character";

/** Confidence in the roles below which the user should check them. */
const SURE = 0.7;

/** A character that is open and not in use yet. */
export interface Prepared {
  /** Makes it perform. */
  take(): void;
  /** Frees it if it is not to perform. */
  dispose(): void;
}

export class Characters {
  readonly #toasts: Toasts;
  readonly #progress: ProgressLine;
  readonly #onChange: () => void;
  #character: Character | undefined;
  #file: File | undefined;
  #roles: ChosenRoles | undefined;
  #performing: Performing | undefined;

  /** `onChange` is called when another body performs; the previous one is freed right after. */
  constructor(toasts: Toasts, progress: ProgressLine, onChange: () => void) {
    [this.#toasts, this.#progress, this.#onChange] = [toasts, progress, onChange];
  }

  /** The rigged character in use; `undefined` for the mannequin. */
  get performing(): Performing | undefined {
    return this.#performing;
  }

  /** The file of the character in use, and the user's mapping of its joints. */
  get file(): File | undefined {
    return this.#file;
  }

  get roles(): ChosenRoles | undefined {
    return this.#roles;
  }

  /** Whether the character may be redistributed, according to its file. */
  get mayHandOn(): boolean {
    return this.#character?.licence?.mayExport ?? true;
  }

  /**
   * Opens a character without making it perform.
   * @param roles the user's mapping of its joints
   * @param accepted whether this user has accepted its terms before
   * @throws StrutError as `loadCharacter`
   */
  async prepare(file: File, roles: ChosenRoles | undefined, accepted: boolean): Promise<Prepared> {
    const { openCharacter } = await import("./open_character");
    const character = await openCharacter(file, {}, roles, accepted);
    return { take: () => this.#take(character, file, roles), dispose: () => character.dispose() };
  }

  /**
   * Opens a file, and makes the character in it perform; if there is none, the current one stays. Returns the file's
   * motions, as BVH files.
   * @param beside files that the file may name
   */
  async open(file: File, beside: readonly DroppedFile[] = []): Promise<Content["motions"]> {
    let whole = file;
    const content = await this.#run(file, async (call) => {
      const { asOneFile, openModel } = await import("./open_character");
      whole = await asOneFile(file, beside);
      return openModel(whole, call);
    });
    if (content?.character) {
      this.#take(content.character, whole);
      this.#announce();
    }
    return content?.motions ?? [];
  }

  #announce(): void {
    const performing = this.#performing!;
    const { performs, unsure } = strings.page.characters;
    const { warnings } = this.#character!;
    if (performing.unsure) this.#toasts.note(unsure(performing.name));
    else announce(performs(performing.name));
    if (warnings.length > 0) this.#toasts.note(warnings.join(" "));
  }

  /** Asks the user to check the joint mapping, and binds the character accordingly. */
  async checkJoints(): Promise<void> {
    const file = this.#file;
    if (!this.#character || !file) return;
    const { askForJoints, openCharacter } = await import("./open_character");
    const roles = await askForJoints(this.#character);
    const corrected = roles && (await this.#run(file, (call) => openCharacter(file, call, roles)));
    if (corrected) this.#take(corrected, file, roles);
  }

  /** Returns to the mannequin. */
  leave(): void {
    this.#take();
  }

  /** The character's file with a motion; `undefined` for the mannequin. @throws StrutError `licence` */
  glb(motion: StyledPoses): Uint8Array<ArrayBuffer> | undefined {
    return this.#character?.toGLB(motion);
  }

  dispose(): void {
    this.#character?.dispose();
  }

  /** Opens a part of a file with progress; `undefined` if that fails, after reporting the error. */
  async #run<T>(file: File, open: (call: CallOptions) => Promise<T>): Promise<T | undefined> {
    try {
      const opened = await this.#progress.run(strings.page.characters.reading(file.name), open);
      this.#toasts.clearErrors();
      return opened;
    } catch (error) {
      // A user who does not accept the terms needs no error message.
      if (!isCancellation(error) && codeOf(error) !== "licence") this.#toasts.failure(error);
      return undefined;
    }
  }

  #take(character?: Character, file?: File, roles?: ChosenRoles): void {
    const before = this.#character;
    [this.#character, this.#file, this.#roles] = [character, file, roles];
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
