/** How much memory a database takes in WebAssembly, open and in use. */
import type { Database, Instance } from "./engines";
import type { EngineName } from "./report";
import type { Query } from "./workload";

/** Target styles of what is measured with several. */
export const STYLES = 3;

/** The same share of the first {@link STYLES} styles. */
export const evenStyles = (database: Database): Float32Array =>
  Float32Array.from(database.styles(), (_, style) => (style < STYLES ? 1 / STYLES : 0));

/** Megabytes of WASM memory. It grows with what is styled, as targets are computed when they are first read. */
export interface Memory {
  engine: EngineName;
  /** With the database open. */
  open_mb: number;
  /** Once one query has been styled, unlabelled. */
  one_style_mb: number;
  /** Once it has been styled with three styles. */
  three_styles_mb: number;
  /** Once all queries have been, which are of every class. */
  every_class_mb: number;
}

/** Measures with a database that has been opened in fresh memory; memory never shrinks. */
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
