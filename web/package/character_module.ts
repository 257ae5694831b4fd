/**
 * Where the module of characters lies, where `loadStrut({ assets })` says so. The entries of the package are files of their own
 * that share nothing: what one of them is told another one finds under a name of the page's.
 */
const KEY = Symbol.for("strut-motion.characterModule");

type Shared = { [KEY]?: string };

/** Says where the module lies, an absolute address. */
export function placeCharacterModule(address: string): void {
  (globalThis as Shared)[KEY] = address;
}

/** Where the module lies; `undefined` where nobody said so: beside the code. */
export const placedCharacterModule = (): string | undefined => (globalThis as Shared)[KEY];
