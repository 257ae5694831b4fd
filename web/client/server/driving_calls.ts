/** The driving calls for a server that has them. Their code is loaded with the first call. */
import type { Arguments, Result } from "../messages";
import type { Caller } from "../rpc_server";
import type { Host } from "./host";

const NAMES = ["openDrive", "drive", "restyleDrive", "resetDrive", "driven", "takePoses"] as const;
export type DrivingMethod = (typeof NAMES)[number];

/** A handler for each call. */
export type DrivingCalls = {
  [M in DrivingMethod]: (host: Host, caller: Caller, ...args: Arguments<M>) => Result<M> | Promise<Result<M>>;
};

type Handler = (...args: unknown[]) => unknown;

export const DRIVING_CALLS = Object.fromEntries(
  NAMES.map((name) => [name, async (...args: unknown[]) => ((await import("./driving"))[name] as Handler)(...args)]),
) as unknown as DrivingCalls;
