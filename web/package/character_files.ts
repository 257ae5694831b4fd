/**
 * Where the files of characters lie, where `loadStrut({ assets })` says so. The entries of the package are files of their own
 * that share nothing: what one of them is told another one finds under a name of the page's.
 */
import { CHARACTER_ASSETS, type CharacterAsset, placeIn } from "./assets";

const KEY = Symbol.for("strut-motion.characterFiles");

type Placed = Partial<Record<CharacterAsset, string>>;
type Shared = { [KEY]?: Placed };

/**
 * Says where the files lie.
 * @param assets `LoadOptions.assets`
 * @param base what relative addresses are relative to
 */
export function placeCharacterFiles(assets: Parameters<typeof placeIn>[0], base: string): void {
  const files = CHARACTER_ASSETS.map((file) => [file, placeIn(assets, file, base)]);
  (globalThis as Shared)[KEY] = Object.fromEntries(files) as Placed;
}

/** The absolute address of a file; `undefined` if no folder was given: the file lies beside the code. */
export const placedCharacterFile = (file: CharacterAsset): string | undefined => (globalThis as Shared)[KEY]?.[file];
