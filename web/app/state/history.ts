/** Undo and redo over anything that can be saved and restored. */

/** Targets of the buttons and keys for undo and redo. */
export interface UndoRedo {
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  undo(): void;
  redo(): void;
}

/** Maximum number of steps that are kept. */
const DEPTH = 200;

/** Two stacks of saved states: those before the current one, and those that were undone. */
export class History<Saved> implements UndoRedo {
  readonly #present: (of: Saved) => Saved;
  readonly #restore: (saved: Saved) => void;
  #past: Saved[] = [];
  #future: Saved[] = [];
  /** The entries that the last step replaced, see {@link withdraw}. */
  #replaced: { oldest: Saved | undefined; future: Saved[] } | undefined;

  /**
   * @param present saves the current state of the object from which the given state was saved
   * @param restore restores a saved state
   */
  constructor(present: (of: Saved) => Saved, restore: (saved: Saved) => void) {
    this.#present = present;
    this.#restore = restore;
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /** Stores the state before an edit, which undo will restore. Undone states can no longer be redone. */
  record(before: Saved): void {
    this.#past.push(before);
    const oldest = this.#past.length > DEPTH ? this.#past.shift() : undefined;
    this.#replaced = { oldest, future: this.#future };
    this.#future = [];
  }

  /** Restores the state before the last recorded step, and the stacks from before it was recorded. */
  withdraw(): void {
    const replaced = this.#replaced;
    const before = replaced && this.#past.pop();
    if (!replaced || before === undefined) return;
    if (replaced.oldest !== undefined) this.#past.unshift(replaced.oldest);
    this.#future = replaced.future;
    this.#replaced = undefined;
    this.#restore(before);
  }

  undo(): void {
    this.#move(this.#past, this.#future);
  }

  redo(): void {
    this.#move(this.#future, this.#past);
  }

  /** Removes all steps, because their objects no longer exist. */
  forget(): void {
    this.#past = [];
    this.#future = [];
    this.#replaced = undefined;
  }

  #move(from: Saved[], to: Saved[]): void {
    const saved = from.pop();
    if (saved === undefined) return;
    this.#replaced = undefined;
    // Update both stacks first: listeners may read them.
    to.push(this.#present(saved));
    this.#restore(saved);
  }
}
