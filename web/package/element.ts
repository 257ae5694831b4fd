/** `strut-motion/element`: defines `<strut-player>`. Without a document, as on a server, it defines nothing. */
import { hostPlayers, StrutPlayer } from "../element";
import { loadStrut } from "./index";
import { SITE } from "./site";
import type { LoadOptions } from "./types";

export { type FrameDetail, StrutPlayer, type StrutPlayerEventMap } from "../element";
export { StrutError, type StrutErrorCode } from "../engine/errors";
export type * from "./public";

declare global {
  interface HTMLElementTagNameMap {
    "strut-player": StrutPlayer;
  }
}

let options: LoadOptions = {};

/** Sets how the players of this page load their engine. Call it before the first of them loads. */
export function configurePlayers(given: LoadOptions): void {
  options = given;
}

hostPlayers({
  load: () => loadStrut(options),
  loadCharacter: async (source, call) => (await import("./three")).loadCharacter(source, call),
  site: SITE,
});
if (globalThis.customElements && !customElements.get("strut-player"))
  customElements.define("strut-player", StrutPlayer);
