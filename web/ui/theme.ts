/** Light or dark: the system's choice until the user selects one. */

/** The system's choice, or the user's. */
export type Theme = "auto" | "dark" | "light";

const DARK = "(prefers-color-scheme: dark)";
/** Only listened to: reading `matches` of these lists before they fire would suppress their events (Chromium). */
const system = [DARK, "(forced-colors: active)"].map((query) => matchMedia(query));

/** Whether a theme is currently dark. */
export function isDark(theme: Theme): boolean {
  return theme === "auto" ? matchMedia(DARK).matches : theme === "dark";
}

/** The choice that toggles light and dark; if it equals the system's, it is not stored. */
export function opposite(theme: Theme): Theme {
  const wanted = isDark(theme) ? "light" : "dark";
  return isDark("auto") === (wanted === "dark") ? "auto" : wanted;
}

/** Applies the theme to the page. */
export function applyTheme(theme: Theme): void {
  document.documentElement.dataset.theme = isDark(theme) ? "dark" : "light";
}

/** Calls back when the system changes between light and dark, or turns forced colours on or off. */
export function onSystemTheme(callback: () => void, signal: AbortSignal): void {
  for (const setting of system) setting.addEventListener("change", callback, { signal });
}
