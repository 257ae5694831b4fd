/**
 * The page in a frame for one figure of the lessons: its attributes are in the URL's query, its state is the part after
 * #, as in a link of the lesson. It reports the visitor's changes to the embedding page.
 */
import type { StateChange } from "../figures/figure_element";
import { figureAttributesOf, readRequest, toldState } from "./messages";

const figure = document.createElement("strut-figure");
for (const [name, value] of figureAttributesOf(location)) figure.setAttribute(name, value);
document.documentElement.lang = figure.lang || "en";
document.body.append(figure);

addEventListener("message", ({ data }) => {
  const { state, theme } = readRequest(data)?.set ?? {};
  for (const [name, value] of Object.entries({ state, theme })) {
    if (value === null) figure.removeAttribute(name);
    else if (value !== undefined) figure.setAttribute(name, value);
  }
});

figure.addEventListener("statechange", (event) => {
  const { state, settled } = (event as CustomEvent<StateChange>).detail;
  // The message contains only what the page's visitor sees: any page may know it.
  if (settled && parent !== window) parent.postMessage(toldState("statechange", { state }), "*");
});
