/** Starts the page. */
import "./styles/tokens.css";
import "./styles/layout.css";
import "./styles/controls.css";
import "./styles/polygon.css";
import "./styles/timeline.css";
import "./styles/narrow.css";
import type { Role } from "../viewer";
import { startStrutClient } from "../worker/client";
import { App } from "./app";
import { errorText } from "./words";

/** Puts a sentence where the page would be. */
function refuse(root: HTMLElement, sentence: string): void {
  const text = document.createElement("p");
  text.className = "fallback";
  text.setAttribute("role", "alert");
  text.textContent = sentence;
  root.replaceChildren(text);
}

/** Whether the browser can draw the stage. */
function hasWebGl2(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
}

async function start(root: HTMLElement): Promise<void> {
  if (!hasWebGl2()) {
    refuse(
      root,
      "Strut draws with WebGL 2, which this browser does not offer. Switch on hardware acceleration or use another browser.",
    );
    return;
  }
  // The page is built, and asks for its database, while the engine loads.
  const client = startStrutClient();
  const app = new App(root);
  // What it cannot prepare is made when it is needed.
  app.prepare().catch(() => {});
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
