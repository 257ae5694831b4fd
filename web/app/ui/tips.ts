/**
 * What the `title` of a control says, for those without a mouse: it is shown while the keyboard's focus is on the control, and while
 * a finger rests on it. A mouse has the browser's own way.
 */
import { html, setText } from "../../ui/dom";

/** A finger that rests for so long asks what it rests on, milliseconds. */
const LONG_PRESS_MS = 500;
/** A finger that moves so far does not rest, pixels. */
const REST_PX = 10;
/** What a finger asked for stays for so long after it was lifted, milliseconds. */
const READ_MS = 4000;
/** Room between a control and what is said of it, and to the edge of the window, pixels. */
const GAP_PX = 10;

/** Shows them until the signal aborts. */
export function showTips(signal: AbortSignal): void {
  // What it says is the control's description already.
  const tip = html("div", { class: "tip", popover: "manual", "aria-hidden": "true" });
  document.body.append(tip);
  signal.addEventListener("abort", () => tip.remove(), { once: true });
  let byKeys = false;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let pressed: { x: number; y: number; at: number } | undefined;
  /** Whether the present press of a finger has shown something: it does nothing else. */
  let asked = false;

  /** What it is about, while it is shown. */
  let shown: HTMLElement | undefined;

  const changes = new MutationObserver(() => place());
  const hide = () => {
    clearTimeout(timer);
    changes.disconnect();
    if (shown) tip.hidePopover();
    shown = undefined;
  };
  const show = (titled: HTMLElement) => {
    shown = titled;
    changes.observe(titled, { attributeFilter: ["title"] });
    tip.showPopover();
    place();
  };
  const place = () => {
    if (!shown) return;
    setText(tip, shown.title);
    // Measured where nothing narrows it.
    tip.style.cssText = "left: 0; top: 0";
    const { left, top, bottom, width } = shown.getBoundingClientRect();
    const { offsetWidth, offsetHeight } = tip;
    const x = Math.max(GAP_PX, Math.min(innerWidth - offsetWidth - GAP_PX, left + (width - offsetWidth) / 2));
    // Above, where neither the finger nor the list of a control is, if there is room.
    const above = top - GAP_PX - offsetHeight;
    tip.style.cssText = `left: ${x}px; top: ${above >= GAP_PX ? above : bottom + GAP_PX}px`;
  };
  const listen = <K extends keyof DocumentEventMap>(type: K, act: (event: DocumentEventMap[K]) => void) =>
    document.addEventListener(type, act, { signal, capture: true });

  listen("keydown", ({ key }) => {
    if (key === "Tab") byKeys = true;
    else if (key === "Escape") hide();
  });
  // Browsers move the focus to what a finger has left.
  listen("focusin", (event) => {
    if (asked) return;
    hide();
    const titled = byKeys ? titledAt(event) : undefined;
    if (titled) show(titled);
  });
  listen("focusout", () => {
    if (!asked) hide();
  });
  listen("scroll", place);
  listen("pointerdown", (event) => {
    byKeys = false;
    asked = false;
    hide();
    const titled = event.pointerType === "mouse" ? undefined : titledAt(event);
    if (!titled) return;
    pressed = { x: event.clientX, y: event.clientY, at: event.timeStamp };
    timer = setTimeout(() => {
      asked = true;
      show(titled);
    }, LONG_PRESS_MS);
  });
  listen("pointermove", (event) => {
    if (pressed && Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > REST_PX) release(event);
  });
  const release = ({ timeStamp }: PointerEvent) => {
    if (!pressed) return;
    // On a page that is busy a tap is heard of late: it is one all the same.
    if (timeStamp - pressed.at < LONG_PRESS_MS) asked = false;
    pressed = undefined;
    if (asked) timer = setTimeout(hide, READ_MS);
    else hide();
  };
  listen("pointerup", release);
  listen("pointercancel", release);
  // Who asked what a control does has not used it.
  listen("click", (event) => {
    if (!asked) return;
    asked = false;
    event.preventDefault();
    event.stopPropagation();
  });
  listen("contextmenu", (event) => {
    if (pressed) event.preventDefault();
  });
}

/** What has a title at an event, within figures too, and says more than it shows. */
function titledAt(event: Event): HTMLElement | undefined {
  for (const node of event.composedPath())
    if (node instanceof HTMLElement && node.title !== "")
      return node.title === node.textContent?.trim() ? undefined : node;
  return undefined;
}
