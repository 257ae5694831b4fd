/** The open objects of a player: a motion, a database, and the figure that shows them. */
import type { CallOptions, FileReading } from "../client/protocol";
import type { Database, Motion, Source } from "../package/types";
import { html } from "../ui/dom";
import type { Lease } from "../ui/lingering";
import type { Screen } from "../viewer";
import type { Cast, CastSource } from "./cast";
import { Figure, type FigureListeners } from "./figure";
import { schedule, screens, sharedEngine } from "./host";
import type { Settings } from "./settings";

export interface Opened {
  database: Lease<Database>;
  motion: Lease<Motion>;
  screen: Lease<Screen>;
  figure: Figure;
  /** The element in which the figure is drawn. */
  container: HTMLElement;
  /** Why its character does not perform. */
  fault: unknown;
}

/** The objects to open. */
export interface Wanted {
  motion: Source | Motion;
  /** The reading of the motion's file in a link. */
  reading: FileReading | undefined;
  database: Source | Database;
  character: CastSource;
  settings: Settings;
}

/**
 * Opens a figure in `picture`, above the existing one. Its character performs, or the mannequin if the character cannot
 * be loaded.
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
  // The figure is invisible until it replaces the existing one.
  const container = html("div", { class: "picture" });
  picture.append(container);
  let screen: Lease<Screen> | undefined;
  let figure: Figure | undefined;
  try {
    screen = screens.lease();
    const values = { database: database.value, motion: motion.value, screen: screen.value };
    const parts = { strut: await engine.strut(), ...values, container };
    figure = await Figure.open(parts, settings, listeners);
    const fault = await casting;
    await figure.perform(cast.character);
    return { database, motion, screen, figure, container, fault };
  } catch (thrown) {
    figure?.dispose();
    screen?.release();
    container.remove();
    for (const lease of leases) lease.release();
    throw thrown;
  }
}

/** Removes the figure and releases its resources. */
export function closeFigure({ figure, database, motion, screen, container }: Opened): void {
  schedule.remove(figure);
  figure.dispose();
  container.remove();
  screen.release();
  database.release();
  motion.release();
}

/** All leases, or none: if one fails, the others are released. */
async function allOrNone<A, B>([a, b]: readonly [Promise<Lease<A>>, Promise<Lease<B>>]): Promise<[Lease<A>, Lease<B>]> {
  const [first, second] = await Promise.allSettled([a, b]);
  if (first.status === "fulfilled" && second.status === "fulfilled") return [first.value, second.value];
  for (const settled of [first, second]) if (settled.status === "fulfilled") settled.value.release();
  throw first.status === "rejected" ? first.reason : (second as PromiseRejectedResult).reason;
}
