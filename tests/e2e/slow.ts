/** Simulates a slower machine: with STRUT_SLOW=4 pages take four times as long, and answers are delayed. */
import type { Browser, Page } from "playwright-core";

/** Delay of an answer or a frame per factor of slowness, milliseconds. */
const ANSWER_MS = 60;
const PICTURE_MS = 20;

/** Slows the pages of a browser down by `rate`; 1 changes nothing. */
export function slowDown(browser: Browser, rate: number): void {
  if (rate <= 1) return;
  browser.on("context", (context) => {
    // Before the scripts of a test, which may replace the browser's `Worker`.
    const late = context.addInitScript(comeLate, { answerMs: ANSWER_MS * rate, pictureMs: PICTURE_MS * rate });
    const open = context.newPage.bind(context);
    context.newPage = async () => {
      await late;
      const page = await open();
      await throttle(page, rate);
      return page;
    };
  });
}

async function throttle(page: Page, rate: number): Promise<void> {
  const session = await page.context().newCDPSession(page);
  await session.send("Emulation.setCPUThrottlingRate", { rate });
}

/** In a page: delays answers of workers and servers, and frames. */
function comeLate({ answerMs, pictureMs }: { answerMs: number; pictureMs: number }): void {
  const later = globalThis.setTimeout.bind(globalThis);
  const heard = Object.getOwnPropertyDescriptor(Worker.prototype, "onmessage")!;
  Object.defineProperty(Worker.prototype, "onmessage", {
    ...heard,
    set(this: Worker, hear: ((event: MessageEvent) => void) | null) {
      heard.set!.call(this, hear && ((event: MessageEvent) => later(() => hear.call(this, event), answerMs)));
    },
  });
  const { fetch, requestAnimationFrame: request } = globalThis;
  globalThis.fetch = async (...asked) => {
    const answer = await fetch(...asked);
    await new Promise((resolve) => later(resolve, answerMs));
    return answer;
  };
  const waiting = new Map<number, FrameRequestCallback>();
  let last = 0;
  globalThis.requestAnimationFrame = (draw) => {
    const id = ++last;
    waiting.set(id, draw);
    const drawNow = (now: number) => {
      const wanted = waiting.get(id);
      waiting.delete(id);
      wanted?.(now);
    };
    later(() => request(drawNow), pictureMs);
    return id;
  };
  globalThis.cancelAnimationFrame = (id) => void waiting.delete(id);
}
