/** Edits of the field by its panel and its handles. */
import type { FieldVertex } from "../../../client/crowd/limits";
import type { GestureListeners } from "../../../ui/drag";
import type { Store } from "../../state/store";
import { firstField, withoutVertex, withStyle, withVertex } from "./field";
import type { Styles } from "./settings";

/** The current crowd. */
interface EditedCrowd {
  field: readonly FieldVertex[];
  /** Radius of its ground, metres. */
  radius: number;
  styles: Styles | undefined;
}

export class FieldEditor {
  /** They end and cancel the current gesture. */
  readonly gestures: GestureListeners;

  constructor(
    private readonly store: Store,
    private readonly crowd: () => EditedCrowd,
  ) {
    this.gestures = store.gestureListeners;
  }

  choose(index: number): void {
    this.store.edit({ crowdVertex: index });
  }

  /** Changes a vertex. Successive changes of the same values are one undo step until the gesture ends. */
  change(index: number, patch: Partial<Omit<FieldVertex, "style">>): void {
    const field = withVertex(this.crowd().field, index, patch);
    this.store.edit({ field, crowdVertex: index }, `crowd ${Object.keys(patch).join()}`);
  }

  add(style: string): void {
    const { field: before, radius } = this.crowd();
    const field = withStyle(before, style, radius);
    this.store.edit({ field, crowdVertex: field.length - 1 });
  }

  remove(index: number): void {
    const field = withoutVertex(this.crowd().field, index);
    this.store.edit({ field, crowdVertex: Math.max(0, index - 1) });
  }

  /** Returns to the field of a first visit. */
  reset(): void {
    const { styles } = this.crowd();
    if (styles) this.store.edit({ field: firstField(styles.all, styles.neutral), crowdVertex: 0 });
  }
}
