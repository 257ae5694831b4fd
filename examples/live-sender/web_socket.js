/** A WebSocket server that only sends (RFC 6455): no more than a sender on this computer needs. */
import { createHash } from "node:crypto";
import { createServer } from "node:http";

const GUID = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
const TEXT = 0x81;
const BINARY = 0x82;
const CLOSE = 0x88;

/**
 * Sends messages to all who connect to a port of this computer, 0 for any free one.
 * @param first gives the messages that each of them is sent first
 */
export async function serveMessages(port, first = () => []) {
  const sockets = new Set();
  const server = createServer((_, response) => response.writeHead(426).end("This is a WebSocket."));
  server.on("upgrade", (request, socket) => {
    const key = createHash("sha1").update(`${request.headers["sec-websocket-key"]}${GUID}`).digest("base64");
    const answer = ["HTTP/1.1 101 Switching Protocols", "Upgrade: websocket", "Connection: Upgrade"];
    socket.write(`${[...answer, `Sec-WebSocket-Accept: ${key}`].join("\r\n")}\r\n\r\n`);
    sockets.add(socket);
    for (const message of first()) socket.write(frameOf(message));
    // Whatever a receiver says, it is that it goes.
    socket.on("data", () => socket.end(Buffer.of(CLOSE, 0)));
    socket.on("close", () => sockets.delete(socket));
    socket.on("error", () => socket.destroy());
  });
  await new Promise((resolve, reject) => {
    server.once("error", reject);
    server.listen(port, "127.0.0.1", resolve);
  });
  return {
    url: `ws://127.0.0.1:${server.address().port}`,
    /** How many are connected. */
    get receivers() {
      return sockets.size;
    },
    /** Sends text, or bytes. */
    send(message) {
      const frame = frameOf(message);
      for (const socket of sockets) socket.write(frame);
    },
    /** Ends all connections, and takes no more. */
    close() {
      for (const socket of sockets) socket.destroy();
      return new Promise((resolve) => server.close(() => resolve()));
    },
  };
}

/** A message as one frame, which a server does not mask. */
function frameOf(message) {
  const bytes = Buffer.from(message);
  const head = [typeof message === "string" ? TEXT : BINARY];
  if (bytes.length < 126) head.push(bytes.length);
  else if (bytes.length < 65_536) head.push(126, bytes.length >> 8, bytes.length & 255);
  else head.push(127, 0, 0, 0, 0, ...[24, 16, 8, 0].map((shift) => (bytes.length >> shift) & 255));
  return Buffer.concat([Buffer.from(head), bytes]);
}
