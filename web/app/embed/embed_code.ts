/** The code to embed a figure in a page. Pure functions. */
import { escaped, frameOf } from "../ui/frame_code";

/** Options of an embedded figure. */
export interface EmbedChoice {
  /** Size of the frame, CSS pixels. */
  size: { width: number; height: number };
  controls: boolean;
  autoplay: boolean;
  theme: "auto" | "light" | "dark";
  ghost: "beside" | "overlay" | "off";
}

/** The embedded state of a link, and the URL of the site. */
export interface Embedded {
  /** URL of the playground's folder. */
  site: string;
  /** The part of a link after `#`. */
  state: string;
  /** Description of the figure, for screen readers. */
  title: string;
}

/** The attributes of a player, by name; those that are `undefined` are omitted. */
function attributesOf({ state }: Embedded, { controls, autoplay, theme, ghost }: EmbedChoice) {
  const attributes: [name: string, value: string | undefined][] = [
    ["state", state || undefined],
    ["controls", controls ? "" : undefined],
    ["autoplay", autoplay ? "" : undefined],
    ["theme", theme === "auto" ? undefined : theme],
    ["ghost", ghost === "beside" ? undefined : ghost],
  ];
  return attributes.filter((pair): pair is [string, string] => pair[1] !== undefined);
}

/** URL of the page for a frame. */
export function frameAddress(embedded: Embedded, choice: EmbedChoice): string {
  const url = new URL("embed.html", embedded.site);
  for (const [name, value] of attributesOf(embedded, choice)) url.searchParams.set(name, value);
  return url.href;
}

/** The HTML of a frame. */
export function frameCode(embedded: Embedded, choice: EmbedChoice): string {
  return frameOf(frameAddress(embedded, choice), embedded.title, choice.size);
}

/** The HTML of the element, with its script. */
export function elementCode(embedded: Embedded, choice: EmbedChoice): string {
  const script = escaped(new URL("package/strut-player.js", embedded.site).href);
  const attributes = attributesOf(embedded, choice).map(([name, value]) =>
    value === "" ? ` ${name}` : ` ${name}="${escaped(value)}"`,
  );
  return `<script src="${script}"></script>\n<strut-player${attributes.join("")}></strut-player>`;
}
