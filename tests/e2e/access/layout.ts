/** Detection of overflow: texts that are cut off, and boxes that scroll horizontally. */
import type { Page } from "playwright-core";

/**
 * Returns texts that are cut off: wider or higher than a container that hides the overflow. File names may end in an
 * ellipsis.
 */
export const cutOff = (page: Page) =>
  page.evaluate(() =>
    [...document.querySelectorAll<HTMLElement>("#app *")]
      .filter((e) => e.checkVisibility({ visibilityProperty: true, opacityProperty: true }))
      .filter((e) =>
        [...e.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent!.trim() !== ""),
      )
      .filter((e) => !e.closest("svg, select, .visually-hidden, .polygon-weights"))
      .flatMap((e) => {
        const range = document.createRange();
        range.selectNodeContents(e);
        const text = range.getBoundingClientRect();
        for (let box: HTMLElement | null = e; box && box.id !== "app"; box = box.parentElement) {
          const style = getComputedStyle(box);
          const frame = box.getBoundingClientRect();
          const clips = style.overflow !== "visible" || box.matches("button, label");
          const scrolls = /auto|scroll/.test(style.overflow);
          if (style.textOverflow === "ellipsis" || scrolls) return [];
          const out = Math.max(text.right - frame.right, frame.left - text.left, text.bottom - frame.bottom - 2);
          if (clips && out > 1) return [`${e.textContent} in .${box.className}`];
        }
        return [];
      }),
  );

/** Returns boxes, including the page, that scroll horizontally, which only drawings over time and tables may. */
export const scrolledSideways = (page: Page, but: readonly string[]) =>
  page.evaluate(
    (but) =>
      [document.documentElement, ...document.querySelectorAll<HTMLElement>("body, #app, #app *")]
        .filter((e) => e.checkVisibility() && !e.matches(":is(input, textarea, select)"))
        .filter((e) => e.scrollWidth > e.clientWidth + 1 && /auto|scroll/.test(getComputedStyle(e).overflowX))
        .map((e) => `${e.localName}.${e.className}`)
        .filter((name) => !but.some((one) => name.includes(one))),
    but,
  );
