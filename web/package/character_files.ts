/**
 * The addresses of the files of characters that `loadStrut({ assets })` was given. The entries of the package are bundled apart and
 * share no module, so the addresses are a global property under a registered symbol.
 */
import { CHARACTER_ASSETS, type CharacterAsset, placeIn } from "./assets";

const KEY = Symbol.for("strut-motion.characterFiles");

type Placed = Partial<Record<CharacterAsset, string>>;
type Shared = { [KEY]?: Placed };

/**
 * Sets the addresses of the files.
 * @param assets `LoadOptions.assets`
 * @param base what relative addresses are relative to
 */
export function placeCharacterFiles(assets: Parameters<typeof placeIn>[0], base: string): void {
  const files = CHARACTER_ASSETS.map((file) => [file, placeIn(assets, file, base)]);
  (globalThis as Shared)[KEY] = Object.fromEntries(files) as Placed;
}

/** The absolute address of a file; `undefined` if no folder was given: the file lies beside the code. */
export const placedCharacterFile = (file: CharacterAsset): string | undefined => (globalThis as Shared)[KEY]?.[file];
