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

async function start(root: HTMLElement): Promise<void> {
  if (graphics() === "none") {
    refuse(root, strings.page.noWebGl);
    return;
  }
  // The page is built, and asks for its database, while the engine loads.
  const client = startStrutClient();
  // Asking for the graphics took its time: what the browser has to do comes before the page is built.
  await new Promise((resolve) => setTimeout(resolve));
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
