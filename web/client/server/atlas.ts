/** Calls about atlases: all distances between a motion and a database. */
import { Atlas, type AtlasFacts, type AtlasView, type NearestInAtlas, type PackedWindows } from "../../engine/atlas";
import type { Caller } from "../rpc_server";
import { OpenDatabase } from "./databases";
import type { Host } from "./host";
import { CarriedMotion, carriedMotion } from "./motions";
import type { Key, OpenThing } from "./registry";

/** An open atlas. */
class OpenAtlas implements OpenThing {
  static readonly noun = "atlas";
  readonly uses: readonly Key[];

  constructor(
    readonly atlas: Atlas,
    motion: number,
    database: number,
  ) {
    this.uses = [database, motion, CarriedMotion.keyOf(motion, database)];
  }

  dispose(): void {
    this.atlas.dispose();
  }
}

async function openAtlas(
  host: Host,
  caller: Caller,
  id: number,
  motion: number,
  database: number,
  columns: number,
): Promise<AtlasFacts> {
  const { input } = await carriedMotion(host, caller, motion, database);
  const atlas = new Atlas(host.open.get(OpenDatabase, database).database, input, columns);
  host.open.add(id, new OpenAtlas(atlas, motion, database));
  return { frames: atlas.facts.frames.slice(), firsts: atlas.facts.firsts.slice() };
}

const atlasOf = ({ open }: Host, id: number) => open.get(OpenAtlas, id).atlas;

/** Handlers that only the page's own package has. */
export const ATLAS_HANDLERS = {
  openAtlas,
  drawAtlas: (host: Host, _: Caller, id: number, view: AtlasView, columns: Uint32Array) => ({
    distances: atlasOf(host, id).draw(view, columns),
  }),
  nearestInAtlas: (host: Host, _: Caller, id: number, view: AtlasView, column: number, line: number): NearestInAtlas =>
    atlasOf(host, id).nearest(view, column, line),
  atlasPose: (host: Host, _: Caller, id: number, column: number, clip: number, frame: number) => ({
    pose: atlasOf(host, id).pose(column, clip, frame),
  }),
  packAtlas: (host: Host, _: Caller, id: number, view: AtlasView): PackedWindows => atlasOf(host, id).packed(view),
  packAtlasColumns: (host: Host, _: Caller, id: number, view: AtlasView): PackedWindows =>
    atlasOf(host, id).packedColumns(view),
  atlasLines: (host: Host, _: Caller, id: number, view: AtlasView) => ({ lines: atlasOf(host, id).packedLines(view) }),
};
