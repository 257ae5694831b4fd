/** A built-in input as another style performs it, by the packages that know it. */
import type { Performed } from "./types";
import { guarded } from "./wasm";

/** As much of a package as is needed. */
interface Glue {
  Counterpart: {
    of(
      input: string,
      style: string,
    ): { poses(): Float32Array; timeOut(): Float32Array; planted(): Uint8Array; free(): void } | undefined;
  };
}

/** An input as a style performs it; `undefined` where there is no such input or style. */
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
