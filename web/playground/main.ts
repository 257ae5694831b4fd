/** Starts the page. */
import "./styles/tokens.css";
import "./styles/layout.css";
import "./styles/controls.css";
import "./styles/polygon.css";
import "./styles/timeline.css";
import "./styles/narrow.css";
import { graphics, type Role } from "../viewer";
import { startStrutClient } from "../worker/client";
import { App } from "./app";
import { strings } from "./strings/strings";
import { errorText } from "./words";

/** Puts a sentence where the page would be. */
function refuse(root: HTMLElement, sentence: string): void {
  const text = document.createElement("p");
  text.className = "fallback";
  text.setAttribute("role", "alert");
  text.textContent = sentence;
  root.replaceChildren(text);
}

/** Lets the browser do what it has to do besides. */
function otherTasks(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}

async function start(root: HTMLElement): Promise<void> {
  // The engine loads while the page is built; for the browser to start its worker this thread must let go.
  const client = startStrutClient();
  await otherTasks();
  if (graphics() === "none") {
    client.dispose();
    refuse(root, strings.page.noWebGl);
    return;
  }
  await otherTasks();
  const app = new App(root);
  window.strut = {
    get frame() {
      return app.frame;
    },
    get state() {
      return app.state;
    },
    get upToDate() {
      return app.upToDate;
    },
    get analysed() {
      return app.analysed;
    },
    jointScreenPosition: (role: Role) => app.stage.jointPosition(role),
  };
  try {
    await app.start(client);
  } catch (error) {
    app.fail(errorText(error));
  }
}

void start(document.getElementById("app")!);
