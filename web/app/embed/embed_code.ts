/** What is copied into a page to show a figure there. Pure. */

/** How a figure is embedded. */
export interface EmbedChoice {
  /** Size of the frame, CSS pixels. */
  size: { width: number; height: number };
  controls: boolean;
  autoplay: boolean;
  theme: "auto" | "light" | "dark";
  ghost: "beside" | "overlay" | "off";
}

/** What is embedded: the state of a link, and where the site is. */
export interface Embedded {
  /** Address of the playground's folder. */
  site: string;
  /** The part of a link behind `#`. */
  state: string;
  /** Says what is shown, for screen readers. */
  title: string;
}

/** What a frame may do: run its own scripts, and save files that its visitor asks for. */
const SANDBOX = "allow-scripts allow-same-origin allow-downloads";

/** The attributes of a player, by name; `undefined` has none. */
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

/** Address of the page for a frame. */
export function frameAddress(embedded: Embedded, choice: EmbedChoice): string {
  const url = new URL("embed.html", embedded.site);
  for (const [name, value] of attributesOf(embedded, choice)) url.searchParams.set(name, value);
  return url.href;
}

/** The HTML of a frame. */
export function frameCode(embedded: Embedded, choice: EmbedChoice): string {
  const { width, height } = choice.size;
  const src = escaped(frameAddress(embedded, choice));
  return `<iframe src="${src}" title="${escaped(embedded.title)}" width="${width}" height="${height}" loading="lazy" sandbox="${SANDBOX}" allow="fullscreen" style="border:0;max-width:100%"></iframe>`;
}

/** The HTML of the element, with its script. */
export function elementCode(embedded: Embedded, choice: EmbedChoice): string {
  const script = escaped(new URL("package/strut-player.js", embedded.site).href);
  const attributes = attributesOf(embedded, choice).map(([name, value]) =>
    value === "" ? ` ${name}` : ` ${name}="${escaped(value)}"`,
  );
  return `<script src="${script}"></script>\n<strut-player${attributes.join("")}></strut-player>`;
}

/** Text inside an attribute. */
function escaped(text: string): string {
  const entities: Record<string, string> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
  return text.replace(/[&<>"]/g, (character) => entities[character]!);
}
