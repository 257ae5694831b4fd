/** Calls about live stylizers. */
import type { Stylizer } from "../../engine/stylizer";
import type { Styled } from "../../engine/types";
import type { StylizeOptions } from "../protocol";
import type { Caller } from "../rpc_server";
import { OpenDatabase } from "./databases";
import type { Host } from "./host";
import { LiveStylizer } from "./live_stylizer";
import type { OpenThing } from "./registry";

class OpenStylizer implements OpenThing {
  static readonly noun = "stylizer";
  readonly uses: readonly number[];

  constructor(
    database: number,
    private readonly stylizer: Stylizer,
    readonly live: LiveStylizer,
  ) {
    this.uses = [database];
  }

  dispose(): void {
    this.stylizer.dispose();
  }
}

export function createStylizer(
  { engine, open }: Host,
  _: Caller,
  id: number,
  databaseId: number,
  options: StylizeOptions,
  halfLifeSecs: number,
): undefined {
  const { database } = open.get(OpenDatabase, databaseId);
  const stylizer = engine.createStylizer(database, options);
  try {
    const live = new LiveStylizer(stylizer, options, database.info.rateHz, halfLifeSecs);
    open.add(id, new OpenStylizer(databaseId, stylizer, live));
  } catch (thrown) {
    stylizer.dispose();
    throw thrown;
  }
}

export function restyle(
  { open }: Host,
  _: Caller,
  id: number,
  options: StylizeOptions,
  halfLifeSecs: number,
): undefined {
  open.get(OpenStylizer, id).live.configure(options, halfLifeSecs);
}

export function push({ open }: Host, _: Caller, id: number, poses: Float32Array): Styled {
  return open.get(OpenStylizer, id).live.push(poses);
}

export function reset({ open }: Host, _: Caller, id: number): undefined {
  open.get(OpenStylizer, id).live.reset();
}
