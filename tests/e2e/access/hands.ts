/** Input methods of a user: only the keyboard, only one finger, a mouse. The test uses no shortcut. */
import type { CDPSession, Locator, Page } from "playwright-core";
import { expect } from "vitest";
import { drag, middleOf, type Place } from "../browser";

/** Distance of a movement: to the right and down, pixels. Keys move in steps. */
export type Way = Place;

/** User actions on a control, which must be reached first. */
export interface Hands {
  press(control: Locator): Promise<void>;
  /** Moves a handle or a slider. */
  move(handle: Locator, by: Way): Promise<void>;
}

/** Greatest number of tab stops of a page: more are a keyboard trap. */
const MOST_STOPS = 150;
/** Pixels per press of an arrow key. */
const KEY_PX = 10;

/**
 * Only the keyboard: Tab to the control, then Enter, Space or arrows. `onFocus` is called with each control that was
 * reached.
 */
export class Keys implements Hands {
  constructor(
    readonly page: Page,
    readonly onFocus: (control: Locator) => Promise<void> = async () => {},
  ) {}

  async press(control: Locator): Promise<void> {
    await this.#tabTo(control);
    const type = await control.getAttribute("type");
    await this.page.keyboard.press(type === "radio" || type === "checkbox" ? "Space" : "Enter");
  }

  async move(handle: Locator, { x, y }: Way): Promise<void> {
    await this.#tabTo(handle);
    const keys: [string, number][] = [
      [x > 0 ? "ArrowRight" : "ArrowLeft", Math.abs(x)],
      [y > 0 ? "ArrowDown" : "ArrowUp", Math.abs(y)],
    ];
    for (const [key, pixels] of keys)
      for (let press = 0; press < pixels / KEY_PX; press++) await this.page.keyboard.press(key);
  }

  async #tabTo(control: Locator): Promise<void> {
    await control.waitFor();
    const isThere = () => control.evaluate((e) => e.matches(":focus"));
    for (let stop = 0; stop < MOST_STOPS; stop++) {
      if (await isThere()) return this.onFocus(control);
      await this.page.keyboard.press("Tab");
    }
    expect.fail(`Tab does not lead to ${control}`);
  }
}

/** Scrolls at a point like a wheel or a swipe, to bring a control into view. */
type Scroll = (at: Place, by: Way) => Promise<void>;

/** Greatest number of wheel turns or swipes. */
const MOST_SWIPES = 150;

/** Scrolls a control's container with a wheel or with swipes until the control's middle can be hit. */
async function reach(page: Page, control: Locator, scroll: Scroll): Promise<Place> {
  await control.waitFor();
  let before: Place | undefined;
  /** Number of successive checks in which the control had not moved. */
  let still = 0;
  let last = "";
  for (let turn = 0; turn < MOST_SWIPES; turn++) {
    const found = await control.evaluate(whereIs);
    if (found) {
      const { at, hit, by, places, over } = found;
      still = before?.x === at.x && before.y === at.y ? still + 1 : 0;
      // The page may still be scrolling.
      if (hit && still >= 2) return at;
      // If nothing moves, the next point is tried.
      const from = places[still % places.length]!;
      if (!hit) await scroll(from, by);
      before = at;
      last = JSON.stringify({ at, by, from, over });
    }
    await page.waitForTimeout(60);
  }
  expect.fail(`${control} cannot be scrolled to: ${last}`);
}

/**
 * Runs in the page. Returns the middle of a control, whether a press there hits it, how far to scroll, from which
 * points, and which element covers it. Returns nothing for a control that was replaced since it was found, for example
 * in a redrawn drawing.
 */
function whereIs(control: Element): { at: Place; hit: boolean; by: Way; places: Place[]; over: string } | undefined {
  if (!control.isConnected) return undefined;
  const parentOf = (e: Element) => e.parentElement ?? (e.getRootNode() as ShadowRoot).host ?? undefined;
  /** Returns the element at a point, also within shadow roots. */
  const elementAt = (root: Document | ShadowRoot, { x, y }: Place): Element | null => {
    const found = root.elementFromPoint(x, y);
    // If no element of a figure is at the point, its root returns the figure's own element.
    return found?.shadowRoot && found.shadowRoot !== root ? elementAt(found.shadowRoot, { x, y }) : found;
  };
  /** Returns the visible part of the box that scrolls a control along an axis. */
  const viewOf = (axis: "x" | "y") => {
    const scrolls = (e: Element) =>
      axis === "x"
        ? e.scrollWidth > e.clientWidth + 1 && /auto|scroll/.test(getComputedStyle(e).overflowX)
        : e.scrollHeight > e.clientHeight + 1 && /auto|scroll/.test(getComputedStyle(e).overflowY);
    let holder: Element | undefined = control;
    while (holder && !scrolls(holder)) holder = parentOf(holder);
    const { left, right, top, bottom } = (holder ?? document.documentElement).getBoundingClientRect();
    const view = {
      left: Math.max(0, left),
      right: Math.min(innerWidth, right),
      top: Math.max(0, top),
      bottom: Math.min(innerHeight, bottom),
    };
    return { ...view, x: (view.left + view.right) / 2, y: (view.top + view.bottom) / 2 };
  };
  const target = control.querySelector(".handle-target, .planner-target, .vertex-target") ?? control;
  const box = target.getBoundingClientRect();
  const at = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  const below = (control.getRootNode() as Document | ShadowRoot).elementFromPoint(at.x, at.y);
  const hit = below !== null && ((control.closest("label") ?? control).contains(below) || below.contains(control));
  const [down, along] = [viewOf("y"), viewOf("x")];
  const sideways = at.y > down.top && at.y < down.bottom && (at.x < along.left || at.x > along.right);
  const view = sideways ? along : down;
  const by = sideways ? { x: at.x - view.x, y: 0 } : { x: 0, y: at.y - view.y };
  const refuses = sideways ? /^(none|pan-y)$/ : /^(none|pan-x)$/;
  const pans = ({ x, y }: Place) => {
    // The wheel has another function over a 3D picture and a knob, and none over a note, which disappears after a
    // while.
    const top = elementAt(document, { x, y });
    if (top?.closest("canvas, .knob, .toast")) return false;
    for (let e: Element | undefined = top ?? undefined; e; e = parentOf(e))
      if (refuses.test(getComputedStyle(e).touchAction)) return false;
    return true;
  };
  // Points for the finger, outside of draggable drawings.
  const shares = [0.5, 0.75, 0.25, 0.9, 0.1, 0.97, 0.03];
  const places = shares
    .flatMap((across) =>
      shares.map((share) => ({
        x: view.left + across * (view.right - view.left),
        y: view.top + share * (view.bottom - view.top),
      })),
    )
    .filter(pans);
  const over = below?.closest("[class]")?.outerHTML.slice(0, 200) ?? "nothing";
  return { at, hit, by, places: places.length > 0 ? places : [{ x: view.x, y: view.y }], over };
}

/** A mouse with a wheel. */
export class Mouse implements Hands {
  constructor(readonly page: Page) {}

  async press(control: Locator): Promise<void> {
    const { x, y } = await this.#reach(control);
    await this.page.mouse.click(x, y);
  }

  async move(handle: Locator, { x, y }: Way): Promise<void> {
    const from = await this.#reach(handle);
    await drag(this.page, from, { x: from.x + x, y: from.y + y });
  }

  #reach(control: Locator): Promise<Place> {
    return reach(this.page, control, async ({ x, y }, by) => {
      await this.page.mouse.move(x, y);
      await this.page.mouse.wheel(by.x, by.y);
    });
  }
}

/**
 * Chromium omits the click of some taps within 200 ms after a drag over an element that does not scroll, milliseconds.
 */
const BEFORE_TAP_MS = 250;

/** One finger: taps, swipes and drags. */
export class Finger implements Hands {
  constructor(
    readonly page: Page,
    readonly session: CDPSession,
  ) {}

  async press(control: Locator): Promise<void> {
    const at = await this.#reach(control);
    await this.page.waitForTimeout(BEFORE_TAP_MS);
    await this.#stroke([at]);
  }

  async move(handle: Locator, { x, y }: Way): Promise<void> {
    const from = await this.#reach(handle);
    await this.#stroke(between(from, { x: from.x + x, y: from.y + y }));
  }

  #reach(control: Locator): Promise<Place> {
    // A swipe up scrolls the page down.
    return reach(this.page, control, ({ x, y }, by) =>
      this.#stroke(between({ x, y }, this.#swiped(x - by.x, y - by.y))),
    );
  }

  /** Returns the nearest point on the screen. */
  #swiped(x: number, y: number): Place {
    const { width, height } = this.page.viewportSize()!;
    return { x: Math.min(width - 2, Math.max(2, x)), y: Math.min(height - 2, Math.max(2, y)) };
  }

  /** Puts the finger down at the first point, moves it over the others, and lifts it. */
  async #stroke([first, ...others]: readonly Place[]): Promise<void> {
    const send = (type: "touchStart" | "touchMove" | "touchEnd", touchPoints: Place[]) =>
      this.session.send("Input.dispatchTouchEvent", { type, touchPoints });
    await send("touchStart", [first!]);
    for (const place of others) await send("touchMove", [place]);
    // A finger that is lifted while moving lets the page scroll on.
    if (others.length > 0) await this.page.waitForTimeout(60);
    await send("touchEnd", []);
  }
}

/** Returns points between two points, both included. */
function between(from: Place, to: Place): Place[] {
  const steps = 8;
  return Array.from({ length: steps + 1 }, (_, i) => ({
    x: from.x + ((to.x - from.x) * i) / steps,
    y: from.y + ((to.y - from.y) * i) / steps,
  }));
}

/** Checks that the focused control looks different from the unfocused one, by its surrounding picture. */
export async function expectFocusVisible(page: Page, control: Locator): Promise<void> {
  const { x, y } = await middleOf(control);
  const box = (await control.boundingBox())!;
  const room = 8;
  const clip = {
    x: Math.max(0, x - box.width / 2 - room),
    y: Math.max(0, y - box.height / 2 - room),
    width: box.width + 2 * room,
    height: box.height + 2 * room,
  };
  const focused = await page.screenshot({ clip });
  const name = `${control}`;
  await control.evaluate((e) => (e as HTMLElement).blur());
  const plain = await page.screenshot({ clip });
  await control.evaluate((e) => (e as HTMLElement).focus());
  expect(focused.equals(plain), `the focus is not seen on ${name}`).toBe(false);
}
