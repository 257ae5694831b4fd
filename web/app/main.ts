/**
 * Starts the page. All its style sheets are imported here: index.html shows the page before there is a script, and its
 * appearance must not change when they load.
 */
import "./shell/trusted_types";
import "../ui/tokens.css";
import "./ui/type.css";
import "./shell/layout.css";
import "../ui/controls.css";
import "./ui/wordmark.css";
import "../ui/polygon/polygon.css";
import "./shell/narrow.css";
import "./views/play/play_view.css";
import "./views/play/viewport_panel.css";
import "./views/play/transport.css";
import "./views/play/timeline/timeline.css";
import { startStrutClient } from "../client/client";
import { FirstSteps } from "../client/first_steps";
import { isInstalled } from "../ui/media";
import { keepSite } from "./offline/keep_site";
import { onLaunchedFiles } from "./offline/launched_files";
import { SHARED_QUERY, takeShared } from "./offline/shared_files";
import type { App } from "./shell/app";
import { isSupported } from "./shell/baseline";
import { firstSet, isPlain } from "./shell/first_set";
import { startGraphics } from "./shell/start_graphics";
import { strings } from "./strings/strings";
import { inSlices, otherTasks } from "./ui/tasks";
import { errorText } from "./ui/words";

/** Longest wait for the page to become idle, milliseconds. */
const IDLE_MS = 3000;

/** Shows a sentence instead of the app. */
function refuse(root: HTMLElement, sentence: string): void {
  const text = document.createElement("p");
  text.className = "fallback";
  text.setAttribute("role", "alert");
  text.textContent = sentence;
  root.replaceChildren(text);
}

/** Loads the code of the page and of its renderer, in separate tasks: each blocks the page only briefly. */
async function loadApp(root: HTMLElement): Promise<typeof App> {
  const [viewer, detected] = await Promise.all([import("../viewer"), startGraphics()]);
  if (detected) viewer.setGraphics(detected);
  // The page without a script has the stage at its place, or hides it if a link names another view.
  const stage = root.querySelector(".stage");
  const picture = { width: stage?.clientWidth || innerWidth, height: stage?.clientHeight || innerHeight };
  await inSlices(viewer.preparation(picture));
  const { App } = await import("./shell/app");
  await otherTasks();
  return App;
}

/** Opens the files with which the page was opened. */
async function openGivenFiles(app: App): Promise<void> {
  onLaunchedFiles((files) => app.open(files));
  if (location.search !== SHARED_QUERY) return;
  // They are opened once, however often the page is reloaded.
  history.replaceState(history.state, "", location.pathname + location.hash);
  const files = await takeShared(new URL("./", location.href).href);
  // Other apps share files with the installed page only. In a tab they may come from any page of the web.
  if (isInstalled()) app.open(files);
  else app.offerFiles(files);
}

/** Calls back when the page has been drawn and is idle, or after a while: Safari does not report it. */
function whenIdle(call: () => void): void {
  if ("requestIdleCallback" in globalThis) requestIdleCallback(call, { timeout: IDLE_MS });
  else setTimeout(call, IDLE_MS);
}

/** Loads resources that the first picture does not need. The page works without them. */
function loadTheRest(app: App): void {
  whenIdle(() => app.showTips().catch(() => {}));
}

/** Stores the built site for offline use; the page also works if the browser refuses. */
function keepBuiltSite(app: App): void {
  if (import.meta.env.PROD && "serviceWorker" in navigator)
    whenIdle(() => keepSite((update) => app.offerUpdate(update)).catch(() => {}));
}

async function start(root: HTMLElement): Promise<void> {
  if (!isSupported()) {
    refuse(root, strings.page.oldBrowser);
    return;
  }
  // The engine loads while the page is loaded and built.
  const client = startStrutClient(firstSet(location.hash));
  const firstSteps = isPlain(location.hash) ? FirstSteps.load() : undefined;
  firstSteps?.catch(() => {});
  let app: App;
  try {
    const Loaded = await loadApp(root);
    app = new Loaded(root, client, firstSteps);
  } catch (error) {
    client.dispose();
    refuse(root, strings.page.notBuilt(errorText(error)));
    return;
  }
  window.strut = app.hook;
  loadTheRest(app);
  // A page in the back-forward cache is not disposed of: it may be shown again.
  addEventListener("pagehide", ({ persisted }) => {
    if (!persisted) app.dispose();
  });
  try {
    await app.start();
  } catch (error) {
    app.fail(error);
  }
  await openGivenFiles(app);
  keepBuiltSite(app);
}

void start(document.getElementById("app")!);
