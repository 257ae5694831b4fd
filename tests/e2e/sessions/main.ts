/** A page with only the client: three sessions in one worker, with one database and two motions. */
import { EngineClient, type EngineRestart } from "../../../web/client/engine_client";
import type { ClientSession } from "../../../web/client/handles";

/** Position of a session. */
export interface Place {
  inputFrame: number;
  pose: number[];
}

export interface SessionsHook {
  /** Opens the sessions, each at another position. */
  begin(): Promise<Place[]>;
  /** Makes a call, waits until the worker was replaced, and shows the sessions again. */
  comeBack(): Promise<{ code: string; lost: number; places: Place[] }>;
}

/** As long as opening a database may take on a slow machine. */
const client = new EngineClient({ patience: { silenceMs: 6000, pingMs: 6000 } });
let sessions: ClientSession[] = [];

const places = () =>
  Promise.all(
    sessions.map(async (session): Promise<Place> => {
      const { inputFrame, pose } = await session.step(0);
      return { inputFrame, pose: [...pose] };
    }),
  );

const hook: SessionsHook = {
  async begin() {
    const database = await client.openDatabase({ kind: "demo" });
    const names = await client.builtInMotions();
    const open = (name: string) => client.openMotion({ kind: "built-in", name });
    const [first, second] = [await open(names[0]!), await open(names[1]!)];
    sessions = [
      await client.createSession(database, first, { styles: { old: 1 } }),
      await client.createSession(database, first, { styles: { proud: 0.5 }, k: 20 }),
      await client.createSession(database, second, { timing: false }),
    ];
    for (const [i, session] of sessions.entries()) await session.seek(20 + 10 * i);
    return places();
  },
  async comeBack() {
    const restart = new Promise<EngineRestart>((resolve) => {
      client.onRestart = resolve;
    });
    const code = await sessions[0]!.step(0.1).then(
      () => "",
      (error: { code: string }) => error.code,
    );
    const { lost } = await restart;
    return { code, lost: lost.length, places: await places() };
  },
};

Object.assign(window, { sessions: hook });
