/** Colours of styles: a style keeps its colour while it is in the field. */
import type { ThemeName } from "../../../viewer";

/** The first three are those of the visual tokens; a canvas and shaders need them resolved. */
const PALETTE: Readonly<Record<ThemeName, readonly string[]>> = {
  dark: ["#ff5a36", "#b08fc4", "#f0bf4c", "#5fb3a3", "#df85ad", "#9fbf62", "#6db7d6", "#cf9263"],
  light: ["#c4360f", "#80609b", "#dfa51f", "#2c8374", "#ae4a7d", "#678a25", "#2d83a3", "#965b2e"],
};
/** Colour of agents without a style. */
const AVERAGE: Readonly<Record<ThemeName, string>> = { dark: "#8fa9cf", light: "#43628e" };

export class StyleColours {
  readonly #slots = new Map<string, number>();
  theme: ThemeName = "dark";

  /** Assigns colours to the styles of a field, and releases those of others. */
  take(styles: readonly string[]): void {
    for (const style of [...this.#slots.keys()]) if (!styles.includes(style)) this.#slots.delete(style);
    for (const style of styles) if (!this.#slots.has(style)) this.#slots.set(style, this.#free());
  }

  /** The colour of a style as `#rrggbb`; that of the average walk if it is not in the field. */
  of(style: string): string {
    const slot = this.#slots.get(style);
    const palette = PALETTE[this.theme];
    return slot === undefined ? AVERAGE[this.theme] : palette[slot % palette.length]!;
  }

  get average(): string {
    return AVERAGE[this.theme];
  }

  #free(): number {
    const taken = new Set(this.#slots.values());
    for (let slot = 0; ; slot++) if (!taken.has(slot)) return slot;
  }
}

/** Red, green and blue of `#rrggbb`, 0 to 255. */
export function rgbOf(hex: string): [number, number, number] {
  return [1, 3, 5].map((at) => Number.parseInt(hex.slice(at, at + 2), 16)) as [number, number, number];
}
