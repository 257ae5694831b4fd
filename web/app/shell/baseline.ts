/**
 * The oldest browsers that run the page: Chrome and Edge 123, Firefox 125, Safari 17.5. They are detected by features
 * that older ones lack, not by the browser's name.
 */

/** A module with one SIMD instruction: `v128.const` and `drop`. */
const SIMD_MODULE = Uint8Array.from([
  ...[0, 97, 115, 109, 1, 0, 0, 0],
  ...[1, 4, 1, 96, 0, 0],
  ...[3, 2, 1, 0],
  ...[10, 23, 1, 21, 0, 253, 12, ...new Array<number>(16).fill(0), 26, 11],
]);

/** The features that are checked; all other required features are older. */
const FEATURES: readonly (() => boolean)[] = [
  () => CSS.supports("color", "light-dark(white, black)"),
  () => "popover" in HTMLElement.prototype,
  () => "toSorted" in Array.prototype && "hasOwn" in Object,
  () => new DecompressionStream("deflate-raw") !== undefined,
  () => WebAssembly.validate(SIMD_MODULE),
];

/** Whether this browser has everything that the page and the engine need, except for graphics. */
export function isSupported(features: readonly (() => boolean)[] = FEATURES): boolean {
  return features.every((has) => {
    try {
      return has();
    } catch {
      return false;
    }
  });
}
