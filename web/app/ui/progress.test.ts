import { afterEach, beforeEach, expect, it, vi } from "vitest";

/** A fake element with the properties that the progress line uses. */
class FakeElement {
  readonly attributes: Record<string, string> = {};
  readonly style: Record<string, string> = {};
  readonly children: (FakeElement | string)[] = [];
  isConnected = true;
  set hidden(hidden: boolean) {
    if (hidden) this.attributes.hidden = "";
    else delete this.attributes.hidden;
  }
  get hidden(): boolean {
    return "hidden" in this.attributes;
  }
  get textContent(): string {
    return this.children.map((child) => (typeof child === "string" ? child : child.textContent)).join("");
  }
  set textContent(text: string) {
    this.replaceChildren(text);
  }
  getAttribute(name: string): string | null {
    return this.attributes[name] ?? null;
  }
  setAttribute(name: string, value: string): void {
    this.attributes[name] = value;
  }
  removeAttribute(name: string): void {
    delete this.attributes[name];
  }
  append(...children: (FakeElement | string)[]): void {
    this.children.push(...children);
    for (const child of children) if (child instanceof FakeElement) log.push(...statuses(child));
  }
  replaceChildren(...children: (FakeElement | string)[]): void {
    this.children.length = 0;
    this.append(...children);
    if (this.attributes.role === "status") log.push(this.textContent);
  }
  addEventListener(): void {}
}

/** Announcements of live regions. */
let log: string[];
const statuses = (element: FakeElement): string[] =>
  element.attributes.role === "status" ? [element.textContent] : [];

beforeEach(() => {
  vi.useFakeTimers();
  log = [];
  const made = { createElement: () => new FakeElement(), createElementNS: () => new FakeElement() };
  vi.stubGlobal("document", { ...made, body: new FakeElement() });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
  vi.resetModules();
});

/** Runs a task of two seconds that reports its progress a hundred times. */
async function run(ends: "well" | "ill"): Promise<FakeElement> {
  const { ProgressLine } = await import("./progress");
  const line = new ProgressLine();
  log = [];
  const running = line.run("Reading.", async ({ onProgress }) => {
    for (let i = 0; i < 100; i++) {
      await new Promise((resolve) => setTimeout(resolve, 20));
      onProgress?.({ label: `Reading ${i} of 100.`, fraction: i / 100 });
      if (i === 50) {
        const [bar] = (line.element as unknown as FakeElement).children as FakeElement[];
        expect(bar!.attributes).toMatchObject({ role: "progressbar", "aria-valuenow": "50", "aria-valuemax": "100" });
        expect(bar!.attributes["aria-label"]).toBe("Reading 50 of 100.");
      }
    }
    if (ends === "ill") throw new Error("No.");
  });
  const outcome = running.catch(() => undefined);
  await vi.runAllTimersAsync();
  await outcome;
  return line.element as unknown as FakeElement;
}

it("has its beginning and its end announced, and nothing between", async () => {
  const element = await run("well");
  expect(log).toEqual(["Reading.", "Done."]);
  expect(element.hidden).toBe(true);
});

it("does not say that it is done where it failed", async () => {
  await run("ill");
  expect(log).toEqual(["Reading.", "Stopped."]);
});
