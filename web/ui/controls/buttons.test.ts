import { afterEach, expect, it, vi } from "vitest";
import { Segment } from "./buttons";

/** An element without a page. */
class FakeElement extends EventTarget {
  readonly children: (FakeElement | string)[] = [];
  readonly attributes: Record<string, string> = {};
  checked = false;
  constructor(readonly localName: string) {
    super();
  }
  getAttribute(name: string): string | null {
    return this.attributes[name] ?? null;
  }
  setAttribute(name: string, value: string): void {
    this.attributes[name] = value;
  }
  append(...children: (FakeElement | string)[]): void {
    this.children.push(...children);
  }
}

afterEach(() => vi.unstubAllGlobals());

/** Names of the groups of radio buttons in an element. */
function groups(node: FakeElement | string): string[] {
  if (typeof node === "string") return [];
  return [...(node.localName === "input" ? [node.attributes.name!] : []), ...node.children.flatMap(groups)];
}

it("each segment is a radio group of its own, whatever its label", () => {
  vi.stubGlobal("document", { createElement: (name: string) => new FakeElement(name) });
  const options = [
    { value: "a", label: "A" },
    { value: "b", label: "B" },
  ];
  const made = ["Quality", "Quality", "品質", "速度"].map((label) => {
    const { element } = new Segment(label, options, () => {});
    return groups(element as unknown as FakeElement);
  });
  for (const [first, second] of made) expect(first).toBe(second);
  expect(new Set(made.flat()).size).toBe(made.length);
});
