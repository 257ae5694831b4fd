/** WebKit: the browser of WebKitGTK, which has Safari's engine, over WebDriver. */
import { type ChildProcess, spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { createServer } from "node:net";
import { type BrowserPage, DRAG_STEPS, type Place, type Plain, SIZE } from "./page";

/** The driver in Debian's package `webkit2gtk-driver`, and the browser of its library. */
const DRIVER = "/usr/bin/WebKitWebDriver";
const BROWSERS = ["x86_64", "aarch64"].map((arch) => `/usr/lib/${arch}-linux-gnu/webkit2gtk-4.1/MiniBrowser`);

/** Path of the browser; `undefined` where it or its driver is missing. */
export const webkitPath = existsSync(DRIVER) ? BROWSERS.find((path) => existsSync(path)) : undefined;

/** Timeout for the start of the driver, milliseconds. */
const START_MS = 20_000;
/** WebDriver's codes of keys that are not characters. */
const KEYS: Readonly<Record<string, string>> = {
  Enter: "\uE007",
  Escape: "\uE00C",
  Tab: "\uE004",
  ArrowRight: "\uE014",
};

const REST = { type: "pause", duration: 0 };

/** Calls the driver; an error in its answer is thrown. */
async function call<T>(base: string, method: string, path: string, body?: object): Promise<T> {
  const response = await fetch(base + path, { method, ...(body && { body: JSON.stringify(body) }) });
  const { value } = (await response.json()) as { value: T & { error?: string; message?: string } };
  if (!response.ok) throw new Error(`${method} ${path}: ${value.error}: ${value.message}`);
  return value;
}

function freePort(): Promise<number> {
  return new Promise((resolve) => {
    const server = createServer().listen(0, () => {
      const { port } = server.address() as { port: number };
      server.close(() => resolve(port));
    });
  });
}

/** Starts the driver and waits until it answers. */
async function startDriver(): Promise<{ base: string; driver: ChildProcess }> {
  const port = await freePort();
  const driver = spawn(DRIVER, [`--port=${port}`], {
    stdio: "ignore",
    // In a container no sandbox is possible; the page is the project's own.
    env: { ...process.env, LIBGL_ALWAYS_SOFTWARE: "1", WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS: "1" },
  });
  const base = `http://127.0.0.1:${port}`;
  const until = performance.now() + START_MS;
  for (;;) {
    const answers = await call(base, "GET", "/status").then(
      () => true,
      () => false,
    );
    if (answers) return { base, driver };
    if (performance.now() > until) throw new Error("WebKitWebDriver does not answer.");
    await new Promise((later) => setTimeout(later, 100));
  }
}

const move = ({ x, y }: Place) => ({ type: "pointerMove", x: Math.round(x), y: Math.round(y), duration: 0 });
const DOWN = { type: "pointerDown", button: 0 };
const UP = { type: "pointerUp", button: 0 };

export async function launchWebkit(): Promise<BrowserPage> {
  const { base, driver } = await startDriver();
  const options = { "webkitgtk:browserOptions": { binary: webkitPath, args: ["--automation"] } };
  const { sessionId, capabilities } = await call<{ sessionId: string; capabilities: { browserVersion: string } }>(
    base,
    "POST",
    "/session",
    { capabilities: { alwaysMatch: options } },
  );
  const session = `${base}/session/${sessionId}`;
  const act = (...actions: object[]) =>
    call<null>(session, "POST", "/actions", {
      actions: [{ type: "pointer", id: "mouse", parameters: { pointerType: "mouse" }, actions }],
    }).then(() => {});
  await call(session, "POST", "/window/rect", { x: 0, y: 0, ...SIZE });
  await call(session, "POST", "/timeouts", { script: 240_000, pageLoad: 240_000 });
  return {
    browser: `WebKitGTK ${capabilities.browserVersion}`,
    open: async (url) => {
      await call(session, "POST", "/url", { url });
    },
    evaluate: async <T, A extends Plain[]>(work: (...args: A) => T | Promise<T>, ...args: A): Promise<T> => {
      const script = `const [args, tell] = [[...arguments].slice(0, -1), arguments[arguments.length - 1]];
        Promise.resolve().then(() => (${work})(...args)).then((value) => tell({ value }), (error) => tell({ error: String(error) }));`;
      const answer = await call<{ value: T; error?: string }>(session, "POST", "/execute/async", { script, args });
      if (answer.error !== undefined) throw new Error(answer.error);
      return answer.value;
    },
    click: (at, times = 1) => act(move(at), ...Array.from({ length: times }, () => [DOWN, UP]).flat()),
    drag: ({ from, to }) => {
      const between = Array.from({ length: DRAG_STEPS }, (_, i) => {
        const share = (i + 1) / DRAG_STEPS;
        return move({ x: from.x + (to.x - from.x) * share, y: from.y + (to.y - from.y) * share });
      });
      return act(move(from), DOWN, ...between, REST, UP);
    },
    press: async (key) => {
      const value = KEYS[key] ?? key;
      const actions = [
        { type: "keyDown", value },
        { type: "keyUp", value },
      ];
      await call(session, "POST", "/actions", { actions: [{ type: "key", id: "keyboard", actions }] });
    },
    picture: async () => Buffer.from(await call<string>(session, "GET", "/screenshot"), "base64"),
    close: async () => {
      await call(base, "DELETE", `/session/${sessionId}`);
      driver.kill();
    },
  };
}
