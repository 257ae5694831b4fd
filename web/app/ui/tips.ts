/**
 * Tooltips for keyboard and touch: the `title` of a control is shown while it is focused by Tab, and after a long
 * press. For a mouse the browser shows it.
 */
import { html, setText } from "../../ui/dom";

/** Time after which a press is a long press, milliseconds. */
const LONG_PRESS_MS = 500;
/** A press that moves farther than this is a drag, pixels. */
const REST_PX = 10;
/** A tooltip stays for this time after a long press ends, milliseconds. */
const READ_MS = 4000;
/** Distance of a tooltip from its control and from the edge of the window, pixels. */
const GAP_PX = 10;

/** Shows tooltips until the signal aborts. */
export function showTips(signal: AbortSignal): void {
  // Screen readers have the text as the description of the control.
  const tip = html("div", { class: "tip", popover: "manual", "aria-hidden": "true" });
  document.body.append(tip);
  signal.addEventListener("abort", () => tip.remove(), { once: true });
  let byKeys = false;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let pressed: { x: number; y: number; at: number } | undefined;
  /** Whether the current press is a long press, which only shows the tooltip. */
  let asked = false;

  /** The control whose tooltip is shown. */
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
    // Its size is measured in the corner: at the right edge it would be narrower.
    tip.style.cssText = "left: 0; top: 0";
    const { left, top, bottom, width } = shown.getBoundingClientRect();
    const { offsetWidth, offsetHeight } = tip;
    const x = Math.max(GAP_PX, Math.min(innerWidth - offsetWidth - GAP_PX, left + (width - offsetWidth) / 2));
    // Above the control if there is room: a finger or an open list covers what is below.
    const above = top - GAP_PX - offsetHeight;
    tip.style.cssText = `left: ${x}px; top: ${above >= GAP_PX ? above : bottom + GAP_PX}px`;
  };
  const listen = <K extends keyof DocumentEventMap>(type: K, act: (event: DocumentEventMap[K]) => void) =>
    document.addEventListener(type, act, { signal, capture: true });

  listen("keydown", ({ key }) => {
    if (key === "Tab") byKeys = true;
    else if (key === "Escape") hide();
  });
  // After a long press the browser moves the focus to the control.
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
    // On a busy page the timer may run before the event of a short tap arrives: the event's own time decides.
    if (timeStamp - pressed.at < LONG_PRESS_MS) asked = false;
    pressed = undefined;
    if (asked) timer = setTimeout(hide, READ_MS);
    else hide();
  };
  listen("pointerup", release);
  listen("pointercancel", release);
  // A long press does not activate the control.
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

/** The element with a title at an event, also in shadow roots; none if its text is the title. */
function titledAt(event: Event): HTMLElement | undefined {
  for (const node of event.composedPath())
    if (node instanceof HTMLElement && node.title !== "")
      return node.title === node.textContent?.trim() ? undefined : node;
  return undefined;
}
