/** The packed model of the built-in walks, loaded on demand. */
import { assetOf } from "../assets";
import { inflatedAsset } from "../built_in";

/** The built-in model's `.strutwalk` file. @throws StrutError if it cannot be loaded */
export function loadBuiltInWalkModel(): Promise<Uint8Array<ArrayBuffer>> {
  const asset = assetOf("built_in.strutwalk", () => new URL("../motions/built_in.strutwalk", import.meta.url));
  return inflatedAsset(asset, "built-in walk model");
}
