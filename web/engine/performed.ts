/** A built-in input as performed in another style, from the packages that contain it. */
import type { Performed } from "./types";
import { guarded } from "./wasm";

/** The part of a package that is needed. */
interface Glue {
  Counterpart: {
    of(
      input: string,
      style: string,
    ): { poses(): Float32Array; timeOut(): Float32Array; planted(): Uint8Array; free(): void } | undefined;
  };
}

/** An input as performed in a style; `undefined` if there is no such input or style. */
export function performedBy({ Counterpart }: Glue, input: string, style: string): Performed | undefined {
  return guarded(() => {
    const counterpart = Counterpart.of(input, style);
    if (!counterpart) return undefined;
    const performed = {
      poses: counterpart.poses(),
      timeOut: counterpart.timeOut(),
      planted: counterpart.planted(),
    };
    counterpart.free();
    return performed;
  });
}
