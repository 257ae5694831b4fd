/**
 * Starts the page. Its sheets are all here: index.html shows the page before there is a script, and must not change when it
 * comes.
 */
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
import type { App } from "./shell/app";
import { isSupported } from "./shell/baseline";
import { startGraphics } from "./shell/start_graphics";
import { strings } from "./strings/strings";
import { otherTasks } from "./ui/tasks";
import { errorText } from "./ui/words";

/** Shows a sentence in place of the app. */
function refuse(root: HTMLElement, sentence: string): void {
  const text = document.createElement("p");
  text.className = "fallback";
  text.setAttribute("role", "alert");
  text.textContent = sentence;
  root.replaceChildren(text);
}

/** Loads the code of the page and what it draws with, in tasks of their own: each keeps the page waiting for a moment only. */
async function loadApp(): Promise<typeof App> {
  const [{ graphics, prepareMannequin }] = await Promise.all([import("../viewer"), startGraphics()]);
  await otherTasks();
  if (graphics() !== "none") {
    await otherTasks();
    prepareMannequin();
  }
  await otherTasks();
  const { App } = await import("./shell/app");
  await otherTasks();
  return App;
}

async function start(root: HTMLElement): Promise<void> {
  if (!isSupported()) {
    refuse(root, strings.page.oldBrowser);
    return;
  }
  // The engine loads while the page is loaded and built.
  const client = startStrutClient();
  let app: App;
  try {
    const Loaded = await loadApp();
    app = new Loaded(root, client);
  } catch (error) {
    client.dispose();
    refuse(root, strings.page.notBuilt(errorText(error)));
    return;
  }
  window.strut = app.hook;
  // A page in the back-forward cache is not disposed of: it may be shown again.
  addEventListener("pagehide", ({ persisted }) => {
    if (!persisted) app.dispose();
  });
  try {
    await app.start();
  } catch (error) {
    app.fail(errorText(error));
  }
}

void start(document.getElementById("app")!);
