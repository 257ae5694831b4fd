/** Shared by the players of a page: the engine, one WebGL context, and the schedule of drawing. */
import type { LoadCharacterOptions } from "../character/load";
import type { CharacterSource } from "../character/read";
import type { Character } from "../character/types";
import type { Strut } from "../package/types";
import { Lingering } from "../ui/lingering";
import { Screen } from "../viewer";
import { Schedule } from "./schedule";
import { SharedEngine } from "./shared_engine";

/** Time for which the context is kept without players, milliseconds. */
const LINGER_MS = 2000;

const NO_HOST = "hostPlayers() must be called before a player loads.";

/** The page's settings for its players. */
export interface PlayerHost {
  /** Loads the engine. */
  load: () => Promise<Strut>;
  /** Loads a character; the code for it is loaded with the first one. */
  loadCharacter: LoadCharacter;
  /** URL of the playground; empty if it is not known. */
  site: string;
}

type LoadCharacter = (source: CharacterSource, options: LoadCharacterOptions) => Promise<Character>;

let host: PlayerHost | undefined;
let engine: SharedEngine | undefined;

/** Sets how the players of this page load their engine; to be called before the first of them loads. */
export function hostPlayers(given: PlayerHost): void {
  host = given;
  engine = new SharedEngine(given.load);
}

/** Loads a character with the page's loader. @throws StrutError */
export const loadCharacter: LoadCharacter = (source, options) => {
  if (!host) throw new Error(NO_HOST);
  return host.loadCharacter(source, options);
};

/** The engine of all players. */
export function sharedEngine(): SharedEngine {
  if (!engine) throw new Error(NO_HOST);
  return engine;
}

/** URL of the playground; empty if it is not known. */
export function site(): string {
  return host?.site ?? "";
}

/** The drawing schedule of players. */
export const schedule = new Schedule();

/** The context on which all players draw. */
export const screens = new Lingering(
  LINGER_MS,
  () => Screen.shared(),
  (screen) => screen.dispose(),
);
