/** Poses of a sender behind a WebSocket. */
import { type ErrorParts, StrutError } from "../engine/errors";
import { MAX_MESSAGE_BYTES, type Message, readBinary, readBvh, readJson } from "./messages";
import type { PoseSink, PoseSource } from "./pose_source";

/** All formats of messages. */
export const STREAM_FORMATS = ["json", "binary", "bvh"] as const;
/** Format of messages; see `docs/live.md`. */
export type StreamFormat = (typeof STREAM_FORMATS)[number];

/** State of a connection. */
export type SocketState =
  | { readonly kind: "connecting" }
  | { readonly kind: "open" }
  /** It failed, or ended, and will be tried again after this time, seconds. */
  | { readonly kind: "waiting"; readonly secs: number };

/** Options of `webSocketPoses`. */
export interface WebSocketOptions {
  /** Format of the sender's messages. */
  readonly format: StreamFormat;
  /** Receives the state of the connection. */
  readonly onState?: ((state: SocketState) => void) | undefined;
  /** Receives the number of messages that could not be read so far. */
  readonly onRefused?: ((count: number) => void) | undefined;
}

const NO_SOCKETS: ErrorParts = {
  code: "unsupported",
  message: "WebSocket is not available here.",
  hint: "Node has it from version 22 on.",
};

/** Longest wait between two attempts, seconds. */
const MAX_WAIT_SECS = 30;

/**
 * Poses from a sender that accepts connections at a URL. After a failure the connection is tried again after 1, 2, 4 …
 * 30 s, until the signal aborts. Messages that cannot be read are dropped.
 * @throws StrutError `bad-input` for an invalid URL, or one with `ws:` that is not on this computer
 */
export function webSocketPoses(url: string | URL, { format, onState, onRefused }: WebSocketOptions): PoseSource {
  const address = addressOf(url);
  if (!STREAM_FORMATS.includes(format)) {
    const hint = `Formats: ${STREAM_FORMATS.join(", ")}.`;
    throw new StrutError({ code: "bad-input", message: `There is no format '${format}'.`, hint });
  }
  return {
    async start(sink, signal) {
      if (typeof WebSocket !== "function") throw new StrutError(NO_SOCKETS);
      let waitSecs = 1;
      let refused = 0;
      const refuse = () => {
        refused += 1;
        onRefused?.(refused);
      };
      while (!signal.aborted) {
        onState?.({ kind: "connecting" });
        const opened = await connection(address, format, sink, signal, () => onState?.({ kind: "open" }), refuse);
        if (signal.aborted) return;
        if (opened) waitSecs = 1;
        const host = address.host;
        const ended = opened ? `The connection to ${host} has ended` : `No sender answers at ${host}`;
        sink.lost(`${ended}; trying again in ${waitSecs} s.`);
        onState?.({ kind: "waiting", secs: waitSecs });
        await wait(waitSecs, signal);
        waitSecs = Math.min(2 * waitSecs, MAX_WAIT_SECS);
      }
    },
  };
}

/**
 * The URL of a sender.
 * @throws StrutError `bad-input`
 */
export function addressOf(url: string | URL): URL {
  const refuse = (message: string, hint: string) => new StrutError({ code: "bad-input", message, hint });
  const example = "For example: ws://127.0.0.1:39541.";
  let address: URL;
  try {
    address = new URL(url);
  } catch {
    throw refuse(`'${url}' is not a URL.`, example);
  }
  if (address.protocol !== "ws:" && address.protocol !== "wss:")
    throw refuse(`'${url}' is not the URL of a WebSocket.`, example);
  if (address.protocol === "ws:" && !isLoopback(address.hostname))
    throw refuse(
      `ws: works only for this computer, and ${address.hostname} is another one.`,
      "Use wss: for another computer.",
    );
  // A WebSocket refuses URLs with a fragment.
  address.hash = "";
  return address;
}

/** Whether a host is this computer. */
function isLoopback(host: string): boolean {
  return host === "localhost" || host.endsWith(".localhost") || host === "[::1]" || /^127(\.\d+){3}$/.test(host);
}

/** One connection. Resolves when it has ended, with whether it was ever open. */
function connection(
  address: URL,
  format: StreamFormat,
  sink: PoseSink,
  signal: AbortSignal,
  onOpen: () => void,
  onRefused: () => void,
): Promise<boolean> {
  return new Promise((resolve) => {
    let socket: WebSocket;
    try {
      socket = new WebSocket(address);
    } catch {
      resolve(false);
      return;
    }
    let opened = false;
    const end = () => {
      signal.removeEventListener("abort", end);
      socket.onopen = socket.onmessage = socket.onclose = socket.onerror = null;
      socket.close();
      resolve(opened);
    };
    signal.addEventListener("abort", end, { once: true });
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      opened = true;
      // After reconnecting, the sender may be another program than before.
      if (format !== "bvh") sink.skeleton({ kind: "humanoid" });
      onOpen();
    };
    socket.onclose = end;
    // Node may not fire `close` for a socket that was never open.
    socket.onerror = () => {
      if (!opened) end();
    };
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      const message = read(data, format);
      if (!message) onRefused();
      else if (message.kind === "skeleton") sink.skeleton(message.skeleton);
      // Without the sender's time, only the time of arrival is known.
      else sink.frame(message.secs ?? performance.now() / 1000, message.pose);
    };
  });
}

function read(data: string | ArrayBuffer, format: StreamFormat): Message | undefined {
  if (typeof data !== "string") return format === "binary" ? readBinary(data) : undefined;
  if (data.length > MAX_MESSAGE_BYTES) return undefined;
  return format === "json" ? readJson(data) : format === "bvh" ? readBvh(data) : undefined;
}

function wait(secs: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const end = () => {
      clearTimeout(timer);
      signal.removeEventListener("abort", end);
      resolve();
    };
    const timer = setTimeout(end, 1000 * secs);
    signal.addEventListener("abort", end, { once: true });
  });
}
