/** Script of every page of the documentation: the theme, and the search, which is loaded on demand. */
import { applyTheme, isDark, opposite } from "../ui/theme";

const KEY = "strut-manual-theme";

/** The stored theme; a browser may store nothing. */
function keptTheme(): "auto" | "dark" | "light" {
  try {
    const kept = localStorage.getItem(KEY);
    return kept === "dark" || kept === "light" ? kept : "auto";
  } catch {
    return "auto";
  }
}

function keepTheme(theme: "auto" | "dark" | "light"): void {
  try {
    if (theme === "auto") localStorage.removeItem(KEY);
    else localStorage.setItem(KEY, theme);
  } catch {
    // The page still has the theme.
  }
}

/** The button that changes between light and dark. */
function bindTheme(button: HTMLElement): void {
  let theme = keptTheme();
  const show = () => button.setAttribute("aria-pressed", String(isDark(theme)));
  button.addEventListener("click", () => {
    theme = opposite(theme);
    applyTheme(theme);
    keepTheme(theme);
    show();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);
  show();
}

/** Separate scripts, so that pages opened from a disk can load them. */
function loadScript(name: string): void {
  const script = document.createElement("script");
  script.src = `${document.documentElement.dataset.root}assets/${name}`;
  script.async = false;
  document.head.append(script);
}

function bindSearch(field: HTMLInputElement): void {
  const load = () => {
    loadScript("search_index.js");
    loadScript("search.js");
  };
  field.addEventListener("focus", load, { once: true });
  document.addEventListener("keydown", (event) => {
    const typing =
      event.target instanceof Element && event.target.closest("input, textarea, select, [contenteditable]");
    if (event.key !== "/" || event.ctrlKey || event.metaKey || event.altKey || typing) return;
    event.preventDefault();
    field.focus();
  });
}

/** Elements wider than the page can also be scrolled by keys. */
function bindWide(elements: readonly Element[]): void {
  const update = (element: Element) => {
    if (element.scrollWidth > element.clientWidth) element.setAttribute("tabindex", "0");
    else element.removeAttribute("tabindex");
  };
  const observer = new ResizeObserver((entries) => {
    for (const { target } of entries) update(target);
  });
  for (const element of elements) observer.observe(element);
  // A font that arrives later changes the width of the text, and not of the element.
  void document.fonts.ready.then(() => elements.forEach(update));
}

bindWide([...document.querySelectorAll(".wide")]);
bindTheme(document.querySelector<HTMLElement>(".theme")!);
bindSearch(document.querySelector<HTMLInputElement>("#search")!);
document.querySelector("#map [aria-current]")?.scrollIntoView({ block: "nearest" });
