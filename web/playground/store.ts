/** Holds the state, tells listeners what changed, and remembers edits for undo and redo. */
import { type PlayState, UNDOABLE } from "./state";

type Name = keyof PlayState;
/** The fields that undo takes back. */
type Snapshot = Pick<PlayState, (typeof UNDOABLE)[number]>;
/** Called after every change with the names of the fields that changed. */
export type Listener = (state: Readonly<PlayState>, changed: ReadonlySet<Name>) => void;

/** Most edits that are remembered. */
const DEPTH = 200;

/** Two values of a field that draw the same picture. */
const same = (a: unknown, b: unknown): boolean => a === b || JSON.stringify(a) === JSON.stringify(b);

/** What undo and redo act upon. */
export interface History {
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  undo(): void;
  redo(): void;
}

export class Store implements History {
  #state: PlayState;
  #past: Snapshot[] = [];
  #future: Snapshot[] = [];
  #gesture: string | undefined;
  #listeners = new Set<Listener>();

  constructor(initial: PlayState) {
    this.#state = initial;
  }

  get state(): Readonly<PlayState> {
    return this.#state;
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /** Calls `listener` after every change; returns what stops it. */
  subscribe(listener: Listener): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /**
   * Changes fields. Successive edits of one `gesture` (a drag, a run of key presses) are one step of undo until
   * {@link endGesture} or an edit without it.
   */
  edit(patch: Partial<PlayState>, gesture?: string): void {
    const changed = this.#changes(patch);
    if (changed.size === 0) return;
    if (UNDOABLE.some((name) => changed.has(name))) {
      if (gesture === undefined || gesture !== this.#gesture) {
        this.#past.push(this.#snapshot());
        if (this.#past.length > DEPTH) this.#past.shift();
      }
      this.#future = [];
      this.#gesture = gesture;
    }
    this.#apply(patch, changed);
  }

  /** Changes fields without a step of undo: defaults filled in, a link followed, an input that was refused. */
  adopt(patch: Partial<PlayState>): void {
    const changed = this.#changes(patch);
    if (changed.size > 0) this.#apply(patch, changed);
  }

  /** Ends a gesture: the next edit is a step of its own. */
  endGesture(): void {
    this.#gesture = undefined;
  }

  undo(): void {
    this.#travel(this.#past, this.#future);
  }

  redo(): void {
    this.#travel(this.#future, this.#past);
  }

  #travel(from: Snapshot[], to: Snapshot[]): void {
    const snapshot = from.pop();
    if (!snapshot) return;
    to.push(this.#snapshot());
    this.#gesture = undefined;
    this.adopt(snapshot);
  }

  #snapshot(): Snapshot {
    return Object.fromEntries(UNDOABLE.map((name) => [name, this.#state[name]])) as unknown as Snapshot;
  }

  #changes(patch: Partial<PlayState>): Set<Name> {
    return new Set((Object.keys(patch) as Name[]).filter((name) => !same(patch[name], this.#state[name])));
  }

  #apply(patch: Partial<PlayState>, changed: ReadonlySet<Name>): void {
    this.#state = { ...this.#state, ...patch };
    this.#notify(changed);
  }

  #notify(changed: ReadonlySet<Name>): void {
    for (const listener of this.#listeners) listener(this.#state, changed);
  }
}
