import { afterEach, describe, expect, it, vi } from "vitest";
import { actionOf, listenToKeys, type PageKeys } from "./keys";

const said: string[] = [];
const say = (what: string) => () => void said.push(what);
const page = (singleKeys = true): PageKeys => ({
  undo: say("undo"),
  redo: say("redo"),
  help: say("help"),
  open: say("open"),
  save: say("save"),
  view: () => ({ " ": say("play"), l: say("loop"), ArrowLeft: say("back") }),
  singleKeys: () => singleKeys,
});

/** An element with the focus. */
function focus(localName: string, attributes: Record<string, string> = {}): Element {
  const is = (selector: string) => {
    const [, name, attribute, value] = /^(\w*)(?:\[([\w-]+)(?:=(\w+))?\])?$/.exec(selector)!;
    const found = attribute === undefined ? "" : attributes[attribute];
    return (!name || name === localName) && found !== undefined && (value === undefined || value === found);
  };
  return {
    localName,
    getAttribute: (name: string) => attributes[name] ?? null,
    matches: (selectors: string) => selectors.split(", ").some(is),
  } as Element;
}

function press(
  key: string,
  options: { focused?: Element; byKeys?: boolean; singleKeys?: boolean; ctrlKey?: boolean; shiftKey?: boolean } = {},
) {
  const { focused = null, byKeys = true, singleKeys = true, ctrlKey = false, shiftKey = false } = options;
  said.length = 0;
  actionOf({ key, ctrlKey, shiftKey, metaKey: false, altKey: false }, focused, page(singleKeys), byKeys)?.();
  return said.join();
}

describe("a key", () => {
  it("does what the view says, whatever the case", () => {
    expect([press("l"), press("L"), press("ArrowLeft"), press(" ")]).toEqual(["loop", "loop", "back", "play"]);
    expect(press("constructor")).toBe("");
  });

  it("undoes and redoes", () => {
    const ctrl = { ctrlKey: true };
    expect([press("z", ctrl), press("Z", { ...ctrl, shiftKey: true }), press("y", ctrl)]).toEqual([
      "undo",
      "redo",
      "redo",
    ]);
    expect(press("l", ctrl)).toBe("");
  });

  it("opens and saves, wherever the focus is", () => {
    const focused = focus("input[type=text]");
    expect([press("o", { ctrlKey: true }), press("S", { ctrlKey: true, focused })]).toEqual(["open", "save"]);
    expect(press("s", { ctrlKey: true, shiftKey: true })).toBe("");
  });

  it("is left to what has the focus", () => {
    expect(press("l", { focused: focus("select") })).toBe("");
    expect(press(" ", { focused: focus("button") })).toBe("");
    expect(press("ArrowLeft", { focused: focus("button") })).toBe("back");
    expect(press(" ", { focused: focus("a") })).toBe("");
    expect(press("ArrowLeft", { focused: focus("input", { type: "radio" }) })).toBe("");
  });

  it("acts where a control has the focus by a click", () => {
    for (const control of [focus("button"), focus("g", { role: "button" }), focus("input", { type: "radio" })]) {
      expect(press(" ", { focused: control, byKeys: false })).toBe("play");
      expect(press("ArrowLeft", { focused: control, byKeys: false })).toBe("back");
    }
  });

  it("is a text field's own, and so is its undo", () => {
    const fields = [
      focus("textarea"),
      focus("div", { contenteditable: "true" }),
      focus("input"),
      ...["text", "number", "search"].map((type) => focus("input", { type })),
    ];
    for (const focused of fields) {
      expect(press("z", { focused, ctrlKey: true })).toBe("");
      expect([press("l", { focused }), press(" ", { focused }), press("ArrowLeft", { focused })]).toEqual(["", "", ""]);
    }
    expect(press("z", { focused: focus("input", { type: "range" }), ctrlKey: true })).toBe("undo");
  });

  it("of a single character does nothing where those are switched off; Space and arrows still act", () => {
    const off = { singleKeys: false };
    expect([press("l", off), press("?", off), press("3", off)]).toEqual(["", "", ""]);
    expect([press(" ", off), press("ArrowLeft", off), press("z", { ...off, ctrlKey: true })]).toEqual([
      "play",
      "back",
      "undo",
    ]);
    expect(press("?")).toBe("help");
  });
});

describe("a click", () => {
  afterEach(() => vi.unstubAllGlobals());

  /** Clicks an element, with the `detail` of a mouse, which screen readers and switch devices send too. */
  function click(focused: Element): boolean {
    let isFocused = true;
    const window = new EventTarget();
    const element = class {
      blur(): void {
        isFocused = false;
      }
    };
    vi.stubGlobal("addEventListener", window.addEventListener.bind(window));
    vi.stubGlobal("HTMLElement", element);
    vi.stubGlobal("SVGElement", element);
    vi.stubGlobal("document", { activeElement: Object.assign(new element(), focused) });
    const life = new AbortController();
    listenToKeys(page(), life.signal);
    window.dispatchEvent(Object.assign(new Event("click"), { detail: 1 }));
    life.abort();
    return isFocused;
  }

  it("does not blur a control, so that the keyboard continues from it", () => {
    for (const control of [focus("button"), focus("a"), focus("summary"), focus("input", { type: "checkbox" })])
      expect(click(control), control.localName).toBe(true);
    expect(click(focus("canvas")), "the canvas handles keys itself").toBe(false);
  });
});
