/**
 * `strut-player.js`, the script tag: everything that `<strut-player>` needs but the walks, which lie beside it as `walk.bin`
 * and, for frames that may not fetch, as the script `walk.bin.js`. What few need is in the folder `assets`.
 */
import "../engine/whole";
import { serve } from "../client/server/serve";
import { hostPlayers, StrutPlayer } from "../element";
import { StrutError } from "../engine/errors";
import { loadInlined } from "./load_inlined";
import { SITE } from "./site";
import type { Servers } from "./start";

type Characters = typeof import("./three");

const { src } = document.currentScript as HTMLScriptElement;
const folder = new URL(".", src).href;

/** Frames with `sandbox="allow-scripts"` have no origin that a server could allow to fetch. */
const mayFetch = location.origin !== "null";

/** Runs a script that calls {@link receive}, and resolves with what it gave. */
function received(file: string): Promise<Uint8Array<ArrayBuffer>> {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    const name = "strutReceive";
    Object.assign(globalThis, {
      [name]: (text: string) => resolve(Uint8Array.from(atob(text), (c) => c.charCodeAt(0))),
    });
    script.onload = () => script.remove();
    const message = `The built-in motions could not be loaded: there is no ${file} beside strut-player.js.`;
    const hint = "Reload the page; if that does not help, the site was not deployed completely.";
    script.onerror = () => reject(new StrutError({ code: "load", message, hint }));
    script.src = new URL(file, folder).href;
    document.head.append(script);
  });
}

/** Databases are built in a worker alone: what builds them is as large as all else here but three.js and the engine. */
const SERVERS: Servers = {
  serve,
  serveBuilds: () => {
    const message = "A database cannot be built here, as the page allows no workers.";
    throw new StrutError({ code: "unsupported", message, hint: "Build it with 'strut build-db', and give the file." });
  },
};

async function load() {
  const walk = mayFetch ? {} : { "walk.bin": await received("walk.bin.js") };
  return loadInlined((file) => `${folder}${file === "walk.bin" ? file : `assets/${file}`}`, {}, SERVERS, walk);
}

/** With three.js of its own: few need it, and a script cannot share what is inside it. @throws StrutError */
async function loadCharacter(...given: Parameters<Characters["loadCharacter"]>) {
  const module: Promise<Characters> = import(`${folder}strut-character.js`);
  const { loadCharacter: load } = await module.catch((cause: unknown) => {
    const message = "Characters cannot perform here: strut-character.js could not be loaded.";
    const hint = "It belongs beside strut-player.js; a frame without an origin may not load it.";
    throw new StrutError({ code: "load", message, hint }, cause);
  });
  return load(...given);
}

hostPlayers({ load, loadCharacter, site: SITE });
if (!customElements.get("strut-player")) customElements.define("strut-player", StrutPlayer);
