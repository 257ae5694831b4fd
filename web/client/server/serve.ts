/** The worker's side of the protocol: one engine, and any number of databases, motions, sessions and stylizers by id. */
import { Engine } from "../../engine/engine";
import { StrutError, toStrutError } from "../../engine/errors";
import type { Arguments, Call, Method, Reply, Request, Result } from "../messages";
import { BuiltInMotions } from "./built_in_motions";
import * as databases from "./databases";
import type { DrivingCalls, DrivingMethod } from "./driving_calls";
import type { Counterparts, Host } from "./host";
import * as motions from "./motions";
import { Registry } from "./registry";
import * as sessions from "./sessions";
import * as stylizers from "./stylizers";
import type { Caller } from "./time_slices";

/** The part of a worker's global scope that the server needs. */
export interface ServerPort {
  postMessage(message: Reply, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}

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
  /** Pending calls, and which of them were cancelled. */
  const cancelled = new Map<number, boolean>();
  const builtIn = new BuiltInMotions();
  const open = new Registry();
  const handlers: Partial<Handlers> = { ...HANDLERS, compareSearch, ...driving, ...page };
  const loading = Engine.load().then((engine): Host => ({ engine, builtIn, counterparts, open }));

  const answer = async (call: Call) => {
    const { id } = call;
    cancelled.set(id, false);
    const caller: Caller = {
      isCancelled: () => cancelled.get(id) === true,
      report: (progress) => port.postMessage({ kind: "progress", id, progress }, []),
    };
    try {
      const value = await handle(handlers, await loading, caller, call);
      port.postMessage({ kind: "result", id, value }, buffersOf(value));
    } catch (thrown) {
      port.postMessage({ kind: "failure", id, error: toStrutError(thrown).parts() }, []);
    } finally {
      cancelled.delete(id);
    }
  };
  port.onmessage = ({ data }) => {
    if (data.kind === "cancel") {
      if (cancelled.has(data.id)) cancelled.set(data.id, true);
    } else if (data.kind === "ping") port.postMessage({ kind: "pong" }, []);
    else if (data.kind === "preload") builtIn.preload(data.set);
    else void answer(data);
  };
  await loading.then(
    () => port.postMessage({ kind: "ready" }, []),
    (thrown) => port.postMessage({ kind: "not-ready", error: toStrutError(thrown).parts() }, []),
  );
}

function handle(
  handlers: Partial<Handlers>,
  host: Host,
  caller: Caller,
  call: Call,
): Result<Method> | Promise<Result<Method>> {
  // A call pairs each method with its own arguments; TypeScript does not follow that through the index.
  const handler = handlers[call.method] as
    | ((host: Host, caller: Caller, ...args: unknown[]) => Result<Method>)
    | undefined;
  if (!handler)
    throw new StrutError({ code: "unsupported", message: "This engine does not support the call.", hint: "" });
  return handler(host, caller, ...call.args);
}

/** The buffers of the typed arrays directly in an answer. Handlers return arrays without another owner. */
function buffersOf(value: unknown): Transferable[] {
  if (typeof value !== "object" || value === null) return [];
  return Object.values(value).flatMap((field) => (ArrayBuffer.isView(field) ? [field.buffer as ArrayBuffer] : []));
}
