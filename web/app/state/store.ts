/** Holds the state, notifies listeners of changes, and records edits for undo and redo. */
import type { GestureListeners } from "../../ui/drag";
import { History, type UndoRedo } from "./history";
import { type AppState, UNDOABLE } from "./state";

type Name = keyof AppState;
/** The fields that undo restores. */
type Snapshot = Pick<AppState, (typeof UNDOABLE)[number]>;
/** Called after every change with the names of the fields that changed. */
type Listener = (state: Readonly<AppState>, changed: ReadonlySet<Name>) => void;

/** Whether two values of a field are equal. */
const same = (a: unknown, b: unknown): boolean => a === b || JSON.stringify(a) === JSON.stringify(b);

export class Store implements UndoRedo {
  #state: AppState;
  readonly #history = new History<Snapshot>(
    () => this.#snapshot(),
    (saved) => {
      this.#gesture = undefined;
      this.adopt(saved);
    },
  );
  #gesture: string | undefined;
  /** The state before the current gesture. */
  #before: Snapshot | undefined;
  #listeners = new Set<Listener>();
  /** Ends and cancels the current gesture: for controls whose edits belong to gestures. */
  readonly gestureListeners: GestureListeners = {
    onSettle: () => this.endGesture(),
    onCancel: () => this.cancelGesture(),
  };

  constructor(initial: AppState) {
    this.#state = initial;
  }

  get state(): Readonly<AppState> {
    return this.#state;
  }

  get canUndo(): boolean {
    return this.#history.canUndo;
  }

  get canRedo(): boolean {
    return this.#history.canRedo;
  }

  /** Calls `listener` after every change, until `signal` aborts. */
  subscribe(listener: Listener, signal?: AbortSignal): void {
    if (signal?.aborted) return;
    this.#listeners.add(listener);
    signal?.addEventListener("abort", () => this.#listeners.delete(listener), { once: true });
  }

  /**
   * Changes fields. Successive edits of one `gesture` (a drag, a run of key presses) are one undo step until {@link
   * endGesture}, {@link cancelGesture} or an edit without a gesture.
   */
  edit(patch: Partial<AppState>, gesture?: string): void {
    const changed = this.#changes(patch);
    if (changed.size === 0) return;
    if (UNDOABLE.some((name) => changed.has(name))) {
      if (gesture === undefined || gesture !== this.#gesture) {
        this.#before = this.#snapshot();
        this.#history.record(this.#before);
      }
      this.#gesture = gesture;
    }
    this.#apply(patch, changed);
  }

  /** Changes fields without an undo step: defaults filled in, or an input that could not be opened. */
  adopt(patch: Partial<AppState>): void {
    const changed = this.#changes(patch);
    if (changed.size > 0) this.#apply(patch, changed);
  }

  /** Ends a gesture: the next edit is a step of its own. A gesture that ends where it began leaves no undo step. */
  endGesture(): void {
    if (this.#gesture !== undefined && same(this.#before, this.#snapshot())) {
      this.#history.withdraw();
      // The state has not changed, but there is one step less.
      this.#notify(new Set());
    }
    this.#gesture = undefined;
  }

  /** Reverts the edits of the current gesture, which leaves no undo step. */
  cancelGesture(): void {
    if (this.#gesture !== undefined) this.#history.withdraw();
  }

  undo(): void {
    this.#history.undo();
  }

  redo(): void {
    this.#history.redo();
  }

  #snapshot(): Snapshot {
    return Object.fromEntries(UNDOABLE.map((name) => [name, this.#state[name]])) as unknown as Snapshot;
  }

  #changes(patch: Partial<AppState>): Set<Name> {
    return new Set((Object.keys(patch) as Name[]).filter((name) => !same(patch[name], this.#state[name])));
  }

  #apply(patch: Partial<AppState>, changed: ReadonlySet<Name>): void {
    this.#state = { ...this.#state, ...patch };
    this.#notify(changed);
  }

  #notify(changed: ReadonlySet<Name>): void {
    for (const listener of this.#listeners) listener(this.#state, changed);
  }
}
