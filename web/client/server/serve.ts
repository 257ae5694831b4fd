/** The worker's side of the protocol: one engine, and any number of databases, motions, sessions and stylizers by id. */
import { Engine } from "../../engine/engine";
import { StrutError, toStrutError } from "../../engine/errors";
import type { Arguments, Method, Result } from "../messages";
import { answerCalls, type Caller, type ServerPort } from "../rpc_server";
import { BuiltInMotions } from "./built_in_motions";
import * as databases from "./databases";
import type { DrivingCalls, DrivingMethod } from "./driving_calls";
import type { Counterparts, Host } from "./host";
import * as motions from "./motions";
import { Registry } from "./registry";
import * as sessions from "./sessions";
import * as stylizers from "./stylizers";

type Handlers = {
  [M in Method]: (host: Host, caller: Caller, ...args: Arguments<M>) => Result<M> | Promise<Result<M>>;
};

/** Calls that only the package of the Compare view has. */
type Comparing = Pick<Handlers, "compareSearch">;

/** Calls that only the page's own package has. */
type OfThePage = Pick<
  Handlers,
  | "openAtlas"
  | "drawAtlas"
  | "nearestInAtlas"
  | "atlasPose"
  | "packAtlas"
  | "packAtlasColumns"
  | "atlasLines"
  | "recordMotion"
  | "neutralClips"
  | "clipOfDatabase"
>;

/** Handlers that all servers have. */
const HANDLERS: Omit<Handlers, keyof Comparing | keyof OfThePage | DrivingMethod> = {
  openDatabase: databases.openDatabase,
  builtInInputs: databases.builtInInputs,
  openMotion: motions.openMotion,
  readMotion: motions.readMotion,
  motionOn: motions.motionOn,
  stylize: motions.stylize,
  counterpart: motions.counterpart,
  createSession: sessions.createSession,
  configure: sessions.configure,
  setLoop: sessions.setLoop,
  step: sessions.step,
  seek: sessions.seek,
  continueFrom: sessions.continueFrom,
  analyse: sessions.analyse,
  examples: sessions.examples,
  exportBvh: sessions.exportBvh,
  createStylizer: stylizers.createStylizer,
  restyle: stylizers.restyle,
  push: stylizers.push,
  reset: stylizers.reset,
  memory: ({ engine }) => engine.memory(),
  close: ({ open }, _, id) => {
    open.close(id);
  },
};

/** Additional handlers of a server. */
interface ServerSetup extends Partial<Comparing> {
  counterparts?: Counterparts;
  driving?: DrivingCalls;
  page?: OfThePage;
}

/** Loads the engine and answers the calls that arrive at `port`. */
export async function serve(
  port: ServerPort,
  { counterparts = () => undefined, compareSearch = () => undefined, driving, page }: ServerSetup = {},
): Promise<void> {
  const builtIn = new BuiltInMotions();
  const open = new Registry();
  const handlers: Partial<Handlers> = { ...HANDLERS, compareSearch, ...driving, ...page };
  const loading = Engine.load().then((engine): Host => ({ engine, builtIn, counterparts, open }));
  const answer = async (method: string, args: unknown[], caller: Caller) => {
    const host = await loading;
    // A call pairs each method with its own arguments; TypeScript does not follow that through the index.
    const handler = handlers[method as Method] as
      | ((host: Host, caller: Caller, ...args: unknown[]) => unknown)
      | undefined;
    if (handler) return handler(host, caller, ...args);
    throw new StrutError({ code: "unsupported", message: "This engine does not support the call.", hint: "" });
  };
  answerCalls(port, answer, (set) => builtIn.preload(set));
  await loading.then(
    () => port.postMessage({ kind: "ready" }, []),
    (thrown) => port.postMessage({ kind: "not-ready", error: toStrutError(thrown).parts() }, []),
  );
}
