/** The code to embed a figure of a lesson in another page. Pure functions. */
import type { Language } from "../../../figures/languages";
import { escaped, frameOf } from "../../ui/frame_code";

/** An embedded figure. */
export interface EmbeddedFigure {
  /** URL of the site's folder. */
  site: string;
  kind: string;
  language: Language;
  /** The text of a link. */
  state: string;
  /** Its heading, for screen readers. */
  heading: string;
}

/** Size of a frame, CSS pixels. */
const SIZE = { width: 688, height: 480 };

/** URL of the page for a frame. */
export function figureAddress({ site, kind, language, state }: EmbeddedFigure): string {
  return `${new URL("figure.html", site).href}?kind=${kind}&lang=${language}#${state}`;
}

/** The HTML of a frame. */
export function figureFrameCode(figure: EmbeddedFigure): string {
  return frameOf(figureAddress(figure), figure.heading, SIZE);
}

/** The HTML of the element, with its script. */
export function figureElementCode({ site, kind, language, state }: EmbeddedFigure): string {
  const script = escaped(new URL("strut-figure.js", site).href);
  return `<script type="module" src="${script}"></script>\n<strut-figure kind="${kind}" lang="${language}" state="${escaped(state)}"></strut-figure>`;
}
