/** Starts the page. */
import "../ui/tokens.css";
import "./ui/type.css";
import "./shell/layout.css";
import "../ui/controls.css";
import "./ui/wordmark.css";
import "../ui/polygon/polygon.css";
import "./shell/narrow.css";
import { startStrutClient } from "../client/client";
import { App } from "./shell/app";
import { isSupported } from "./shell/baseline";
import { strings } from "./strings/strings";
import { errorText } from "./ui/words";

/** Shows a sentence in place of the app. */
function refuse(root: HTMLElement, sentence: string): void {
  const text = document.createElement("p");
  text.className = "fallback";
  text.setAttribute("role", "alert");
  text.textContent = sentence;
  root.replaceChildren(text);
}

/** Yields so that the browser can start the worker. */
function otherTasks(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}

async function start(root: HTMLElement): Promise<void> {
  if (!isSupported()) {
    refuse(root, strings.page.oldBrowser);
    return;
  }
  // The engine loads while the page is built.
  const client = startStrutClient();
  await otherTasks();
  let app: App;
  try {
    app = new App(root, client);
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
