/**
 * Completes the state of the view from a model: links omit defaults, and values for other variables do not fit. Pure
 * functions.
 */
import { type KeyStyleState, LENGTH_RANGE, type TimedValue } from "../../state/key_style";

/** Default values of a model. */
interface ModelDefaults {
  /** Values of the style variables of the mean pose. */
  middle: readonly number[];
  firstKeys: () => TimedValue[];
}

type Completed = Pick<KeyStyleState, "keys" | "keyChosen" | "keyTrail" | "keyLength" | "keyHandle">;

/** Whether the state has a handle position in the model's variables. */
export function hasHandle({ keyHandle }: Pick<KeyStyleState, "keyHandle">, { middle }: ModelDefaults): boolean {
  return keyHandle.length === middle.length;
}

/**
 * The state with the model's defaults for missing or unsuitable values.
 *
 * @param stale - Whether the handle belongs to other variables, of the same number.
 */
export function completed(state: Completed, model: ModelDefaults, stale = false): Completed {
  const fits = ({ values }: TimedValue) => values.length === model.middle.length;
  const keysFit = state.keys.every(fits);
  const handled = hasHandle(state, model);
  let keys = keysFit ? state.keys : [];
  // Keys that the user removed while the handle has a position are not filled in again.
  if (keys.length === 0 && !handled) keys = model.firstKeys();
  return {
    keys,
    keyChosen: keysFit ? state.keyChosen : -1,
    keyTrail: state.keyTrail.every(fits) ? state.keyTrail : [],
    keyLength: state.keyLength || Math.max(LENGTH_RANGE.min, keys.at(-1)?.secs ?? 0),
    keyHandle: handled && !stale ? state.keyHandle : model.middle,
  };
}
