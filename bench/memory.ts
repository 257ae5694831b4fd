/** WebAssembly memory of a database, when open and in use. */
import type { Database, Instance } from "./engines";
import type { EngineName } from "./report";
import type { Query } from "./workload";

/** Number of target styles in measurements with several styles. */
export const STYLES = 3;

/** Returns equal weights of the first {@link STYLES} styles. */
export const evenStyles = (database: Database): Float32Array =>
  Float32Array.from(database.styles(), (_, style) => (style < STYLES ? 1 / STYLES : 0));

/** Megabytes of WASM memory. It grows with the styled motion, because targets are computed when they are first read. */
export interface Memory {
  engine: EngineName;
  /** With the database open. */
  open_mb: number;
  /** After one query was styled, unlabelled. */
  one_style_mb: number;
  /** After the query was styled with three styles. */
  three_styles_mb: number;
  /** After all queries were styled, which cover every class. */
  every_class_mb: number;
}

/** Measures a database that was opened in new memory; memory never shrinks. */
export function measureMemory(
  { glue, memory }: Instance,
  engine: EngineName,
  database: Database,
  queries: readonly Query[],
): Memory {
  const megabytes = () => memory().buffer.byteLength / 1e6;
  const open_mb = megabytes();
  const stylizer = new glue.Stylizer(database);
  stylizer.push(queries[0]!.poses);
  const one_style_mb = megabytes();
  stylizer.setStyles(evenStyles(database));
  stylizer.push(queries[0]!.poses);
  const three_styles_mb = megabytes();
  for (const { poses } of queries) stylizer.push(poses);
  stylizer.free();
  return { engine, open_mb, one_style_mb, three_styles_mb, every_class_mb: megabytes() };
}
