/** What does not fit: texts that are cut off, and boxes that are scrolled sideways. */
import type { Page } from "playwright-core";

/** Texts that are cut off: wider or higher than what holds them and hides the rest. Names of files may end in dots. */
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

/** Boxes, the page among them, that a person scrolls sideways; drawings over time and tables may need it. */
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
