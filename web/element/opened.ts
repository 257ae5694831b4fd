/** What a player has open: a motion, a database, and the figure that shows them. */
import type { CallOptions, FileReading } from "../client/protocol";
import type { Database, Motion, Source } from "../package/types";
import { html } from "../ui/dom";
import type { Cast, CastSource } from "./cast";
import { Figure, type FigureListeners } from "./figure";
import { joinScreen, leaveScreen, schedule, sharedEngine } from "./host";
import type { Settings } from "./settings";
import type { Lease } from "./shared_engine";

export interface Opened {
  database: Lease<Database>;
  motion: Lease<Motion>;
  figure: Figure;
  /** Where the figure is drawn. */
  container: HTMLElement;
  /** Why its character does not perform. */
  fault: unknown;
}

/** What is to be opened. */
export interface Wanted {
  motion: Source | Motion;
  /** What a link says of how the motion's file is read. */
  reading: FileReading | undefined;
  database: Source | Database;
  character: CastSource;
  settings: Settings;
}

/**
 * Opens a figure in `picture`, above what is there; its character performs, or the mannequin where that cannot be loaded.
 * @throws StrutError
 */
export async function openFigure(
  { motion: source, reading, database: base, character, settings }: Wanted,
  { cast, picture, listeners }: { cast: Cast; picture: HTMLElement; listeners: FigureListeners },
  call: CallOptions,
): Promise<Opened> {
  const engine = sharedEngine();
  const casting = cast.take(character, call).catch((thrown: unknown) => thrown);
  const leases = await allOrNone([engine.database(base, call), engine.motion(source, { reading })]);
  const [database, motion] = leases;
  // The figure before it is seen until this one takes its place.
  const container = html("div", { class: "picture" });
  picture.append(container);
  let figure: Figure | undefined;
  try {
    const screen = joinScreen();
    const parts = { strut: await engine.strut(), database: database.value, motion: motion.value, screen, container };
    figure = await Figure.open(parts, settings, listeners);
    const fault = await casting;
    await figure.perform(cast.character);
    return { database, motion, figure, container, fault };
  } catch (thrown) {
    figure?.dispose();
    leaveScreen();
    container.remove();
    for (const lease of leases) lease.release();
    throw thrown;
  }
}

/** Takes the figure away and gives back what it used. */
export function closeFigure({ figure, database, motion, container }: Opened): void {
  schedule.remove(figure);
  figure.dispose();
  container.remove();
  leaveScreen();
  database.release();
  motion.release();
}

/** All leases, or none: those that were had are released where another one fails. */
async function allOrNone<A, B>([a, b]: readonly [Promise<Lease<A>>, Promise<Lease<B>>]): Promise<[Lease<A>, Lease<B>]> {
  const [first, second] = await Promise.allSettled([a, b]);
  if (first.status === "fulfilled" && second.status === "fulfilled") return [first.value, second.value];
  for (const settled of [first, second]) if (settled.status === "fulfilled") settled.value.release();
  throw first.status === "rejected" ? first.reason : (second as PromiseRejectedResult).reason;
}
