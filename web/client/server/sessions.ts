/** Calls about playback sessions. */
import type { ClipJob } from "../../engine/clip_job";
import type { Stylizer } from "../../engine/stylizer";
import type { SessionSetup } from "../messages";
import type { Analysis, CurveSubject, Examples, FrameRange, LiveFrame, ShownFrame, StylizeOptions } from "../protocol";
import type { Caller } from "../rpc_server";
import { OpenDatabase } from "./databases";
import type { Host } from "./host";
import { CarriedMotion, carriedMotion, styleClip } from "./motions";
import type { Key, OpenThing } from "./registry";
import { LiveSession } from "./session";
import { SharedWork } from "./shared_work";

/** A motion playing in a database. Sessions share no state that changes during playback. */
class OpenSession implements OpenThing {
  static readonly noun = "session";
  readonly uses: readonly Key[];
  /** The last clip that was styled as a whole, and its options. */
  styled: { options: StylizeOptions; job: ClipJob } | undefined;
  /** The clip while it is being styled. */
  styling: { options: StylizeOptions; work: SharedWork<ClipJob> } | undefined;

  constructor(
    readonly database: number,
    motion: number,
    readonly carried: CarriedMotion,
    private readonly stylizer: Stylizer,
    readonly live: LiveSession,
    public options: StylizeOptions,
  ) {
    this.uses = [database, motion, CarriedMotion.keyOf(motion, database)];
  }

  dispose(): void {
    this.styled?.job.dispose();
    this.stylizer.dispose();
  }
}

export async function createSession(host: Host, caller: Caller, id: number, setup: SessionSetup): Promise<undefined> {
  const { engine, open } = host;
  const { motion, options, loop, range, inputFrame } = setup;
  const carried = await carriedMotion(host, caller, motion, setup.database);
  const stylizer = engine.createStylizer(open.get(OpenDatabase, setup.database).database, options);
  try {
    const interpolate = engine.interpolate.bind(engine);
    const live = Object.assign(new LiveSession(stylizer, carried.input.info, options, interpolate), { loop, range });
    if (inputFrame !== undefined) live.seek(inputFrame);
    open.add(id, new OpenSession(setup.database, motion, carried, stylizer, live, options));
  } catch (thrown) {
    stylizer.dispose();
    throw thrown;
  }
}

export function configure({ open }: Host, _: Caller, id: number, options: StylizeOptions): undefined {
  const session = open.get(OpenSession, id);
  session.live.configure(options);
  session.options = options;
}

export function setLoop(
  { open }: Host,
  _: Caller,
  id: number,
  loop: boolean,
  range: FrameRange | undefined,
): undefined {
  Object.assign(open.get(OpenSession, id).live, { loop, range });
}

export function step({ open }: Host, _: Caller, id: number, dtSecs: number): LiveFrame {
  return open.get(OpenSession, id).live.step(dtSecs);
}

export function seek({ open }: Host, _: Caller, id: number, inputFrame: number): LiveFrame {
  return open.get(OpenSession, id).live.seek(inputFrame);
}

export function continueFrom({ open }: Host, _: Caller, id: number, shown: ShownFrame): LiveFrame {
  return open.get(OpenSession, id).live.continueFrom(shown);
}

export async function analyse(host: Host, caller: Caller, id: number): Promise<Analysis> {
  return (await styledClip(host, caller, id)).result();
}

export async function examples(host: Host, caller: Caller, id: number, subject: CurveSubject): Promise<Examples> {
  return (await styledClip(host, caller, id)).examples(subject);
}

export async function exportBvh(host: Host, caller: Caller, id: number): Promise<string> {
  return (await styledClip(host, caller, id)).toBvh();
}

/** The session's whole motion with its current options, styled once for all calls that ask for it. */
async function styledClip(host: Host, caller: Caller, id: number): Promise<ClipJob> {
  const session = host.open.get(OpenSession, id);
  const { options } = session;
  if (session.styled?.options === options) return session.styled.job;
  if (session.styling?.options !== options) {
    const work = new SharedWork((all) => style(host, all, session, options), caller);
    session.styling = { options, work };
  }
  return session.styling.work.for(caller);
}

/** Styles the session's whole motion; the session keeps the job. */
async function style(host: Host, caller: Caller, session: OpenSession, options: StylizeOptions): Promise<ClipJob> {
  // Two clips at a time would take twice the memory, and nothing asks for the last one's options again.
  session.styled?.job.dispose();
  session.styled = undefined;
  try {
    const { job } = await styleClip(host, caller, session.carried, session.database, options, session);
    session.styled = { options, job };
    return job;
  } finally {
    if (session.styling?.options === options) session.styling = undefined;
  }
}
