/** Names of live inputs: `live:ws://127.0.0.1:39541`, or `live:bvh:ws://…` if messages are not JSON. */
import { LIVE } from "../../../../player/input_library";
import { STREAM_FORMATS, type StreamFormat } from "../../../../streams/web_socket_poses";

/** A sender. */
export interface LiveAddress {
  readonly url: string;
  readonly format: StreamFormat;
}

/** Initial values of the dialog. */
export const USUAL: LiveAddress = { url: "ws://127.0.0.1:39541", format: "json" };

/** The sender in a name; the default one if there is none. */
export function addressIn(name: string): LiveAddress {
  const rest = name.slice(LIVE.length);
  const format = STREAM_FORMATS.find((known) => rest.startsWith(`${known}:`));
  const url = format ? rest.slice(format.length + 1) : rest;
  return { url: url || USUAL.url, format: format ?? USUAL.format };
}

/** The name of a sender's input. */
export function nameOf({ url, format }: LiveAddress): string {
  return `${LIVE}${format === USUAL.format ? "" : `${format}:`}${url}`;
}
