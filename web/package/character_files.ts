/**
 * The URLs of the character files that `loadStrut({ assets })` received. The entries of the package are bundled
 * separately and share no module, so the URLs are a global property under a registered symbol.
 */
import { CHARACTER_ASSETS, type CharacterAsset, placeIn } from "./assets";

const KEY = Symbol.for("strut-motion.characterFiles");

type Placed = Partial<Record<CharacterAsset, string>>;
type Shared = { [KEY]?: Placed };

/**
 * Sets the URLs of the files.
 * @param assets `LoadOptions.assets`
 * @param base base of relative URLs
 */
export function placeCharacterFiles(assets: Parameters<typeof placeIn>[0], base: string): void {
  const files = CHARACTER_ASSETS.map((file) => [file, placeIn(assets, file, base)]);
  (globalThis as Shared)[KEY] = Object.fromEntries(files) as Placed;
}

/** The absolute URL of a file; `undefined` if no folder was given: the file is next to the code. */
export const placedCharacterFile = (file: CharacterAsset): string | undefined => (globalThis as Shared)[KEY]?.[file];
