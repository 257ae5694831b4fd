/** Offers that are valid until the next edit. */
import { UNDOABLE } from "../state/state";
import type { ProjectPlace } from "./place";

/** Offers an action until the user changes something that undo restores. */
export function offerUntilEdit(
  text: string,
  label: string,
  act: () => void,
  { toasts, store }: Pick<ProjectPlace, "toasts" | "store">,
): void {
  const offered = new AbortController();
  const withdraw = toasts.offer(text, label, () => {
    offered.abort();
    act();
  });
  store.subscribe((_, changed) => {
    if (!UNDOABLE.some((name) => changed.has(name))) return;
    offered.abort();
    withdraw();
  }, offered.signal);
}
