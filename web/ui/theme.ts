/** Light or dark: the system's choice until the person makes one. */

/** The system's choice, or the person's. */
export type Theme = "auto" | "dark" | "light";

const DARK = "(prefers-color-scheme: dark)";
/** Only listened to: reading `matches` of these very lists before they fire would swallow their events (Chromium). */
const system = [DARK, "(forced-colors: active)"].map((query) => matchMedia(query));

/** Whether a theme is dark at the moment. */
export function isDark(theme: Theme): boolean {
  return theme === "auto" ? matchMedia(DARK).matches : theme === "dark";
}

/** The choice that turns light into dark and back; the system's own choice is not written down. */
export function opposite(theme: Theme): Theme {
  const wanted = isDark(theme) ? "light" : "dark";
  return isDark("auto") === (wanted === "dark") ? "auto" : wanted;
}

/** Puts the theme on the page. */
export function applyTheme(theme: Theme): void {
  document.documentElement.dataset.theme = isDark(theme) ? "dark" : "light";
}

/** Calls back when the system becomes light or dark, forces its colours on pages or no longer does. */
export function onSystemTheme(callback: () => void, signal: AbortSignal): void {
  for (const setting of system) setting.addEventListener("change", callback, { signal });
}
