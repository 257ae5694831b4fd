/** The colours around a player: whether they are dark, and custom colours of the page. */
import type { ThemeColours, ThemeName } from "../viewer";

/** Whether the element's colours are dark: `probe` is black only in the dark theme. */
export function themeOf(probe: Element): ThemeName {
  return getComputedStyle(probe).color.replaceAll(" ", "") === "rgb(0,0,0)" ? "dark" : "light";
}

/** Colours of the scene that the page set by custom properties. */
export function ownColours(element: Element): Partial<ThemeColours> {
  const style = getComputedStyle(element);
  const own = (name: string) => hex(style.getPropertyValue(`--strut-${name}`).trim());
  const [signal, ink, input, stage] = [own("signal"), own("ink"), own("input"), own("stage")];
  return {
    ...(signal && { signal }),
    ...(ink && { ink }),
    ...(input && { input }),
    ...(stage && { background: { inner: stage, outer: stage } }),
  };
}

/** Converts a CSS colour to `#rrggbb` for three.js; `undefined` if it is invalid. */
function hex(colour: string): string | undefined {
  if (colour === "" || !CSS.supports("color", colour)) return undefined;
  const context = Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d")!;
  context.fillStyle = colour;
  context.fillRect(0, 0, 1, 1);
  const [r, g, b] = context.getImageData(0, 0, 1, 1).data;
  return `#${[r, g, b].map((value) => value!.toString(16).padStart(2, "0")).join("")}`;
}
