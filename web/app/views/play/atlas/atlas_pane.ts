/** The atlas: the distance of every window of the database from every frame of the input, under the timeline's playhead. */

import "./atlas.css";
import { AtlasDrawing, type Drawn } from "../../../../client/atlas/atlas_drawing";
import type { AtlasPart, AtlasView, ClientAtlas } from "../../../../client/atlas/client_atlas";
import { findGraphics, type GraphicsFound } from "../../../../client/atlas/graphics";
import { type DatabaseInfo, isCancellation } from "../../../../client/protocol";
import type { Session } from "../../../../player/session";
import { button } from "../../../../ui/controls/buttons";
import { formatNumber, html, setText } from "../../../../ui/dom";
import { strings } from "../../../strings/strings";
import { readColours } from "../../../ui/colours";
import { spoken } from "../../../ui/words";
import { AtlasCanvas } from "./atlas_canvas";
import { bandsOf, NEAREST, type Rgb, ramp, Shades, type Span, shifted, zoomed } from "./shades";

/** Maximum number of columns: a walk of ten seconds has one per frame. */
const MAX_COLUMNS = 600;
/** Fewest windows that are shown: half a second to two, so that each has lines of its own. */
const LEAST_SPAN = 60;
/** Height of a label, CSS pixels. */
const LABEL_PX = 13;
/** Factors of zooming in by a notch of the wheel, and by a press of a key or a button. */
const [NOTCH, PRESS] = [0.82, 0.5];
/** Space left and right of the axis, as in the timeline. */
const INSET = 6;
/** A press that moves less than this, in pixels, is a click. */
const CLICK_PX = 4;

/** The page's interface for the pane. */
interface AtlasHost {
  session: Session;
  onPart: (part: AtlasPart) => void;
  /** Called when other windows are shown; `undefined` for all. */
  onWindows: (windows: Span | undefined) => void;
  onClose: () => void;
  /** Called when a window is selected as a ghost, at a frame of the input; `undefined` removes it. */
  onGhost: (ghost: AtlasGhost | undefined) => void;
  onError: (error: unknown) => void;
}

/** A window of the database, aligned with a frame of the input as in the metric. */
export interface AtlasGhost {
  frame: number;
  pose: Float32Array;
}

/** Parts in the order of their chips. */
export const PARTS: readonly AtlasPart[] = ["whole", "legs", "arms", "torso", "head"];

export class AtlasPane {
  readonly element: HTMLElement;
  readonly #host: AtlasHost;
  readonly #chips = new Map<AtlasPart, HTMLButtonElement>();
  readonly #canvas = new AtlasCanvas();
  readonly #labels = html("div", { class: "atlas-labels", "aria-hidden": "true" });
  readonly #lines = html("div", { class: "atlas-lines", "aria-hidden": "true" });
  readonly #head = html("div", { class: "atlas-head", "aria-hidden": "true" });
  readonly #cross = html("div", { class: "atlas-cross", hidden: true, "aria-hidden": "true" });
  readonly #stage: HTMLElement;
  readonly #reading = html("p", { class: "atlas-reading", "aria-live": "polite" });
  readonly #drawnBy = html("p", { class: "caption atlas-by", role: "status" });
  readonly #observer = new ResizeObserver(() => this.#resize());
  readonly #listening = new AbortController();
  #classes: DatabaseInfo["classes"] = [];
  #part: AtlasPart = "whole";
  #span: Span = { first: 0, last: 0 };
  /** The requested windows; `undefined` for all. */
  #asked: Span | undefined;
  #shown = false;
  #open: { atlas: ClientAtlas; drawing: AtlasDrawing } | undefined;
  /** Cancels the current drawing or opening. */
  #busy = new AbortController();
  #shades: Shades | undefined;
  /** Minimum distances by part. */
  #leasts = new Map<AtlasPart, Float32Array>();
  #pointed: { column: number; line: number } | undefined;
  #asking = false;
  #frame = 0;
  #graphics: Promise<GraphicsFound | undefined> | undefined;

  constructor(host: AtlasHost) {
    this.#host = host;
    const say = strings.play.atlas;
    for (const part of PARTS) {
      const chip = button(say.parts[part], () => host.onPart(part), { label: true, class: "chip" });
      this.#chips.set(part, chip);
    }
    this.#stage = html(
      "div",
      { class: "atlas-stage", tabindex: 0, role: "img", "aria-label": say.name, title: "" },
      this.#canvas.element,
      this.#lines,
      this.#head,
      this.#cross,
    );
    const zoom = (factor: number) => () => this.#zoom(factor, 0.5);
    this.element = html(
      "section",
      { class: "atlas", "aria-label": say.name },
      html(
        "div",
        { class: "atlas-panel" },
        html(
          "div",
          { class: "atlas-heading" },
          html("h2", { title: say.why }, say.name),
          button(say.closer, zoom(PRESS), { icon: "add" }),
          button(say.farther, zoom(1 / PRESS), { icon: "less" }),
          button(say.close, host.onClose, { icon: "close", keys: "A" }),
        ),
        html("div", { class: "atlas-parts", role: "group", "aria-label": say.part }, ...this.#chips.values()),
        this.#reading,
        this.#drawnBy,
      ),
      this.#labels,
      this.#stage,
    );
    const { signal } = this.#listening;
    host.session.listen({ onInput: () => this.#reopen(), onDatabase: () => this.#takeDatabase() }, signal);
    this.#listen(signal);
    this.#observer.observe(this.#stage);
  }

  /** Shows the pane for a part of the body, with these windows, or all. */
  show(part: AtlasPart, windows: Span | undefined): void {
    for (const [name, chip] of this.#chips) chip.setAttribute("aria-pressed", String(name === part));
    const before = this.#span;
    const otherPart = part !== this.#part;
    this.#part = part;
    this.#asked = windows;
    if (!this.#shown) {
      this.#shown = true;
      this.recolour();
      this.#reopen();
      return;
    }
    if (this.#open) this.#span = this.#fitting;
    const otherSpan = before.first !== this.#span.first || before.last !== this.#span.last;
    if (otherSpan) this.#point(undefined);
    if (otherPart || otherSpan) this.#draw();
  }

  hide(): void {
    if (!this.#shown) return;
    this.#shown = false;
    this.#close();
    this.#host.onGhost(undefined);
  }

  /** Moves the playhead to an input frame. */
  set frame(frame: number) {
    this.#frame = frame;
    if (this.#shown) this.#head.style.transform = `translateX(${this.#x(frame).toFixed(1)}px)`;
  }

  /** Reads the colours again after a change of theme. */
  recolour(): void {
    const { panel, weight, "weight-edge": edge } = readColours(this.element);
    const stops = [panel, weight, edge].map(rgbOf).filter((colour) => colour !== undefined);
    this.#canvas.ramp = ramp(stops);
  }

  dispose(): void {
    this.hide();
    this.#listening.abort();
    this.#observer.disconnect();
  }

  // --- opening and drawing ---

  #close(): void {
    this.#busy.abort();
    this.#open?.drawing.dispose();
    this.#open?.atlas.dispose();
    this.#open = undefined;
    this.#leasts.clear();
    this.#point(undefined);
  }

  /** Another database has other windows. */
  #takeDatabase(): void {
    if (this.#open && this.#asked) {
      this.#asked = undefined;
      this.#host.onWindows(undefined);
    }
    this.#reopen();
  }

  /** Opens the atlas of the current input in the current database. */
  #reopen(): void {
    const { session } = this.#host;
    this.#close();
    this.#host.onGhost(undefined);
    const { input, database } = session;
    if (!this.#shown || !input || !database) return;
    this.#classes = database.classes;
    void this.#attempt(async (signal) => {
      this.#graphics ??= findGraphics(new URLSearchParams(location.search).get("gpu") === "any");
      const [atlas, found] = await Promise.all([session.openAtlas(MAX_COLUMNS, { signal }), this.#graphics]);
      this.#open = { atlas, drawing: new AtlasDrawing(atlas, found) };
      this.#span = this.#fitting;
      this.#draw();
    });
  }

  /** The displayed part of the requested windows: all if the database does not have them. */
  get #fitting(): Span {
    const count = this.#open?.atlas.firsts.at(-1) ?? 0;
    const asked = this.#asked;
    return asked && asked.last <= count ? zoomed(asked, 1, 0, LEAST_SPAN, count) : { first: 0, last: count };
  }

  /** Number of lines drawn of a span. */
  get #height(): number {
    return Math.max(1, Math.min(Math.round(this.#stage.clientHeight), this.#span.last - this.#span.first));
  }

  get #view(): AtlasView {
    return { part: this.#part, ...this.#span, height: this.#height };
  }

  get #isWhole(): boolean {
    return this.#span.last - this.#span.first === this.#open?.atlas.firsts.at(-1);
  }

  #draw(): void {
    const open = this.#open;
    if (!open || !this.#shown || this.#span.last === 0) return;
    const [view, isWhole, part] = [this.#view, this.#isWhole, this.#part];
    const shades = new Shades(open.atlas.frames.length, view.height, NEAREST[part], this.#leasts.get(part));
    this.#shades = shades;
    this.#leasts.set(part, shades.least);
    this.#canvas.begin(shades, this.#span);
    this.#label();
    void this.#attempt(async (signal) => {
      const drawn = await open.drawing.draw(
        view,
        ({ columns, width, distances }) => {
          for (const [i, column] of columns.entries())
            shades.take(column, width, distances.subarray(i * view.height, (i + 1) * view.height), isWhole);
          this.#canvas.update();
        },
        signal,
      );
      this.#say(drawn);
      this.element.dataset.drawn = drawn.by === undefined ? "processor" : "graphics";
    });
  }

  /** Runs work that replaces the current work; a cancellation is not an error. */
  async #attempt(work: (signal: AbortSignal) => Promise<void>): Promise<void> {
    this.#busy.abort();
    this.#busy = new AbortController();
    const { signal } = this.#busy;
    delete this.element.dataset.drawn;
    try {
      await work(signal);
    } catch (thrown) {
      if (!isCancellation(thrown) && !signal.aborted) this.#host.onError(thrown);
    }
  }

  #say({ by, ms, without }: Drawn): void {
    const say = strings.play.atlas;
    const time = ms < 100 ? `${Math.round(ms)} ms` : `${formatNumber(ms / 1000, 1)} s`;
    const byProcessor = without === "lost" ? say.lost : say.byProcessor(time);
    const offer = without === "absent" ? ` ${say.offer}` : "";
    setText(this.#drawnBy, by === undefined ? byProcessor + offer : say.byGraphics(by, time));
  }

  #resize(): void {
    if (!this.#shown || !this.#shades) return;
    this.frame = this.#frame;
    if (this.#height === this.#shades.height) this.#label();
    else this.#draw();
  }

  /** Draws the names of adjacent groups, and lines between them. */
  #label(): void {
    const { first, last } = this.#span;
    const perPx = (last - first) / Math.max(1, this.#stage.clientHeight);
    const bands = bandsOf(this.#classes, this.#open?.atlas.firsts ?? [], this.#span, LABEL_PX * perPx);
    const percent = (window: number) => `${((100 * (window - first)) / (last - first)).toFixed(2)}%`;
    this.#labels.replaceChildren(
      ...bands
        .filter((band) => band.last - band.first >= LABEL_PX * perPx)
        .map((band) => {
          const label = html("span", { title: spoken(band.label) }, spoken(band.label));
          label.style.top = percent((band.first + band.last) / 2);
          return label;
        }),
    );
    this.#lines.replaceChildren(
      ...bands.slice(1).map((band) => {
        const line = html("i", {});
        line.style.top = percent(band.first);
        return line;
      }),
    );
  }

  // --- input ---

  #zoom(factor: number, at: number): void {
    const count = this.#open?.atlas.firsts.at(-1) ?? 0;
    this.#go(zoomed(this.#span, factor, at, LEAST_SPAN, count));
  }

  #go(span: Span): void {
    if (!this.#open || (span.first === this.#span.first && span.last === this.#span.last)) return;
    this.#span = span;
    this.#asked = this.#isWhole ? undefined : span;
    this.#point(undefined);
    this.#draw();
    this.#host.onWindows(this.#asked);
  }

  #shift(by: number): void {
    const length = this.#span.last - this.#span.first;
    this.#go(shifted(this.#span, Math.round(by * length), this.#open?.atlas.firsts.at(-1) ?? 0));
  }

  #listen(signal: AbortSignal): void {
    const stage = this.#stage;
    const shareOf = ({ clientY }: MouseEvent) => {
      const { top, height } = stage.getBoundingClientRect();
      return Math.min(1, Math.max(0, (clientY - top) / height));
    };
    stage.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        if (event.shiftKey) this.#shift(Math.sign(event.deltaX || event.deltaY) * (1 - NOTCH));
        else this.#zoom(event.deltaY < 0 ? NOTCH : 1 / NOTCH, shareOf(event));
      },
      { passive: false, signal },
    );
    let down: { y: number; span: Span; moved: boolean } | undefined;
    stage.addEventListener(
      "pointerdown",
      (event) => {
        if (event.button !== 0) return;
        down = { y: event.clientY, span: this.#span, moved: false };
        stage.setPointerCapture(event.pointerId);
        this.#point(this.#at(event));
      },
      { signal },
    );
    stage.addEventListener(
      "pointermove",
      (event) => {
        if (down && Math.abs(event.clientY - down.y) > CLICK_PX) down.moved = true;
        if (down?.moved) {
          const { first, last } = down.span;
          const by = ((down.y - event.clientY) / stage.clientHeight) * (last - first);
          this.#go(shifted(down.span, Math.round(by), this.#open?.atlas.firsts.at(-1) ?? 0));
        } else this.#point(this.#at(event));
      },
      { signal },
    );
    stage.addEventListener(
      "pointerup",
      (event) => {
        const clicked = down && !down.moved;
        down = undefined;
        if (clicked) void this.#haunt(this.#at(event));
      },
      { signal },
    );
    stage.addEventListener("pointercancel", () => (down = undefined), { signal });
    stage.addEventListener("pointerleave", () => this.#point(undefined), { signal });
    stage.addEventListener("dblclick", () => this.#zoom(Number.MAX_SAFE_INTEGER, 0), { signal });
    stage.addEventListener("keydown", (event) => this.#onKey(event), { signal });
  }

  #onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const acts: Readonly<Record<string, () => void>> = {
      "+": () => this.#zoom(PRESS, 0.5),
      "-": () => this.#zoom(1 / PRESS, 0.5),
      ArrowUp: () => this.#shift(-0.2),
      ArrowDown: () => this.#shift(0.2),
      Enter: () => {
        const column = this.#columnOf(this.#frame);
        const line = this.#shades?.brightest(column);
        if (line === undefined) return;
        this.#point({ column, line });
        void this.#haunt({ column, line });
      },
      Escape: () => this.#host.onGhost(undefined),
    };
    const act = Object.hasOwn(acts, event.key) ? acts[event.key] : undefined;
    if (!act) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  }

  /** Length of the axis, and its last frame. */
  get #axis(): { length: number; last: number } {
    const { input } = this.#host.session;
    return { length: Math.max(1, this.#stage.clientWidth - 2 * INSET), last: Math.max(1, (input?.frames ?? 2) - 1) };
  }

  #x(frame: number): number {
    const { length, last } = this.#axis;
    return INSET + (frame / last) * length;
  }

  #frameAt(clientX: number): number {
    const { length, last } = this.#axis;
    return ((clientX - this.#stage.getBoundingClientRect().left - INSET) / length) * last;
  }

  /** The column whose frame is nearest to a frame. */
  #columnOf(frame: number): number {
    const frames = this.#open?.atlas.frames ?? [];
    let best = 0;
    for (const [column, of] of frames.entries())
      if (Math.abs(of - frame) < Math.abs(frames[best]! - frame)) best = column;
    return best;
  }

  #at({ clientX, clientY }: MouseEvent): { column: number; line: number } | undefined {
    if (!this.#open || !this.#shades) return undefined;
    const { top, height } = this.#stage.getBoundingClientRect();
    const line = Math.floor(((clientY - top) / height) * this.#shades.height);
    return {
      column: this.#columnOf(this.#frameAt(clientX)),
      line: Math.min(this.#shades.height - 1, Math.max(0, line)),
    };
  }

  /** Shows a readout of the point under the pointer. */
  #point(at: { column: number; line: number } | undefined): void {
    this.#pointed = at;
    this.#cross.hidden = !at || !this.#shades;
    if (!at || !this.#shades) {
      setText(this.#reading, strings.play.atlas.hint);
      return;
    }
    const y = ((at.line + 0.5) / this.#shades.height) * this.#stage.clientHeight;
    const x = this.#x(this.#open?.atlas.frames[at.column] ?? 0);
    this.#cross.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    void this.#read();
  }

  /** Asks the engine for one point after another; those in between are skipped. */
  async #read(): Promise<void> {
    const [at, open, view] = [this.#pointed, this.#open, this.#view];
    if (this.#asking || !at || !open) return;
    this.#asking = true;
    try {
      const { name, frame, distance } = await open.atlas.nearest(view, at.column, at.line);
      if (this.#pointed)
        setText(this.#reading, strings.play.atlas.reading(spoken(name), frame, formatNumber(100 * distance, 2)));
    } catch {
      // It was closed meanwhile, or another view is shown.
    } finally {
      this.#asking = false;
    }
    if (this.#pointed !== at) void this.#read();
  }

  /** Shows the nearest window there as a ghost. */
  async #haunt(at: { column: number; line: number } | undefined): Promise<void> {
    const [open, view] = [this.#open, this.#view];
    if (!at || !open) return;
    try {
      const { clip, frame } = await open.atlas.nearest(view, at.column, at.line);
      const pose = await open.atlas.pose(at.column, clip, frame);
      if (this.#open === open) this.#host.onGhost({ frame: open.atlas.frames[at.column]!, pose });
    } catch (thrown) {
      if (this.#open === open) this.#host.onError(thrown);
    }
  }
}

/** The numbers of a colour in the format of `getComputedStyle`; `undefined` for a transparent one. */
function rgbOf(css: string): Rgb | undefined {
  const [r, g, b, alpha = 1] = [...css.matchAll(/[\d.]+/g)].map(Number);
  return alpha === 0 ? undefined : [r!, g!, b!];
}
