/**
 * `strut-player.js`, the script tag: everything that `<strut-player>` needs except the walks, which are next to it as
 * `walk.bin` and, for frames that may not fetch, as the script `walk.bin.js`. The script `strut-character.js` loads
 * characters, and rarely needed files are in the folder `assets`.
 */
import "../engine/whole";
import { serve } from "../client/server/serve";
import { hostPlayers, StrutPlayer } from "../element";
import { StrutError } from "../engine/errors";
import { loadInlined } from "./load_inlined";
import { received } from "./script";
import { SITE } from "./site";
import type { Servers } from "./start";

type Characters = Pick<typeof import("./three"), "loadCharacter">;

const folder = folderOf(document.currentScript);

/** Frames with `sandbox="allow-scripts"` have no origin to which a server could grant access; their URL still has one. */
const mayFetch = self.origin !== "null";

/** The folder of this script. @throws StrutError if it is not one of the page's classic scripts */
function folderOf(script: HTMLOrSVGScriptElement | null): string {
  if (script instanceof HTMLScriptElement && script.src) return new URL(".", script.src).href;
  const message = "strut-player.js cannot find its own URL, because it was loaded as a module or imported.";
  const hint = 'Load it with <script src="strut-player.js">, or import "strut-motion/element".';
  throw new StrutError({ code: "load", message, hint });
}

/** The walks, from the script that contains them as text. @throws StrutError `load` */
async function walkFromScript(): Promise<Uint8Array<ArrayBuffer>> {
  const file = "walk.bin.js";
  const message = `The built-in motions could not be loaded: ${file} is missing next to strut-player.js.`;
  const hint = "Reload the page; if that does not help, the site was not deployed completely.";
  const text = await received<string>(new URL(file, folder), message, hint);
  return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
}

/** Databases are built only in a worker: the code for it is as large as everything else here except three.js and the engine. */
const SERVERS: Servers = {
  serve,
  serveBuilds: () => {
    const message = "A database cannot be built here, because the page does not allow workers.";
    throw new StrutError({ code: "unsupported", message, hint: "Build it with 'strut build-db', and use the file." });
  },
};

async function load() {
  const walk = mayFetch ? {} : { "walk.bin": await walkFromScript() };
  return loadInlined((file) => `${folder}${file === "walk.bin" ? file : `assets/${file}`}`, {}, SERVERS, walk);
}

let characters: Promise<Characters> | undefined;

/** Uses a copy of three.js of its own: few pages need it, and a script cannot share its contents. @throws StrutError */
async function loadCharacter(...given: Parameters<Characters["loadCharacter"]>) {
  const address = new URL("strut-character.js", folder);
  const message = `Characters cannot be used here: ${address.href} could not be loaded.`;
  characters ??= received<Characters>(address, message, "Put it next to strut-player.js.");
  characters.catch(() => {
    characters = undefined;
  });
  return (await characters).loadCharacter(...given);
}

hostPlayers({ load, loadCharacter, site: SITE });
if (!customElements.get("strut-player")) customElements.define("strut-player", StrutPlayer);
