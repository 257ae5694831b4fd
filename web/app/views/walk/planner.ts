/** The planner: blocks, transitions and the playhead of a plan, edited by the pointer and the keyboard. */
import "./planner.css";
import { formatNumber, html, svg } from "../../../ui/dom";
import { type Drag, listenToDrags } from "../../../ui/drag";
import { placeIn, setSize, sizeOf } from "../../../ui/drawing";
import { clampedValueAt, pixelOf } from "../../../ui/scale";
import type { Store } from "../../state/store";
import { STEP_RANGE, TRANSITION_RANGE, type WalkBlock } from "../../state/walk";
import { strings } from "../../strings/strings";
import { onResize } from "../../ui/resize";
import { Playhead } from "../synthesis/playhead";
import { blockBefore, moveBlock, removeBlock, shiftTransition, withBlock } from "./plan";
import { CHART_HEIGHT, layOutPlanner, type PlannerLayout, ROWS } from "./planner_layout";
import { drawPlan, type PlannerModel, type PlannerPicture } from "./planner_picture";

/** A press that moves farther than this is a drag, pixels. */
const CLICK_PX = 4;
/** Step of an arrow key for the playhead, seconds. */
const KEY_SECS = 0.1;

/** The element under the pointer or with the keyboard focus. */
interface Target {
  kind: "block" | "end" | "middle";
  index: number;
}

export class Planner {
  readonly element: HTMLElement;
  readonly #store: Store;
  readonly #onSeek: (secs: number) => void;
  readonly #root = svg("svg", { class: "planner", role: "group", "aria-label": strings.walk.plan });
  readonly #group = svg("g");
  readonly #playhead: Playhead;
  #model: PlannerModel | undefined;
  #layout: PlannerLayout | undefined;
  #picture: PlannerPicture = { elements: [], bars: [], numbers: [] };
  #secs = 0;
  #step = -1;
  /** Element to focus after the next drawing. */
  #focusNext: string | undefined;

  constructor(store: Store, onSeek: (secs: number) => void) {
    this.#store = store;
    this.#onSeek = onSeek;
    this.#playhead = new Playhead({
      label: strings.synthesis.time,
      rulerY: ROWS.ruler,
      step: KEY_SECS,
      onSeek,
    });
    this.#playhead.bottom = ROWS.chart + CHART_HEIGHT;
    this.#root.append(this.#group, this.#playhead.element);
    this.element = html("div", { class: "planner-box" }, this.#root);
    listenToDrags(this.#root, (press) => this.#begin(press));
    this.#root.addEventListener("keydown", (event) => this.#onKey(event));
    this.#root.addEventListener("keyup", store.gestureListeners.onSettle);
  }

  /** Follows the width of the page until `signal` aborts. */
  attach(signal: AbortSignal): void {
    onResize(this.element, () => this.#draw(), signal);
  }

  show(model: PlannerModel): void {
    this.#model = model;
    this.#draw();
  }

  /** Moves the playhead to a time of the plan, within one of its steps. */
  setPlayhead(secs: number, step: number): void {
    this.#secs = secs;
    if (!this.#layout) return;
    const { time } = this.#layout;
    const text = `${formatNumber(secs, 1)} s, ${strings.walk.stepCaption(step + 1)}`;
    this.#playhead.place({ value: secs, max: time.max, x: pixelOf(time, secs), text });
    if (step === this.#step) return;
    const mark = (index: number, present: boolean) => {
      this.#picture.bars[index]?.classList.toggle("present", present);
      this.#picture.numbers[index]?.classList.toggle("present", present);
    };
    mark(this.#step, false);
    mark(step, true);
    this.#step = step;
  }

  #draw(): void {
    if (!this.#model) return;
    const layout = layOutPlanner(sizeOf(this.element).width, this.#model.walk);
    this.#layout = layout;
    setSize(this.#root, { width: layout.width, height: ROWS.height });
    const active = document.activeElement;
    const focused = active instanceof SVGElement && this.#group.contains(active) ? active.dataset.key : undefined;
    this.#picture = drawPlan(this.#model, layout);
    this.#group.replaceChildren(...this.#picture.elements);
    const focusNext = focused === undefined ? undefined : (this.#focusNext ?? focused);
    this.#focusNext = undefined;
    if (focusNext) this.#group.querySelector<SVGElement>(`[data-key="${focusNext}"]`)?.focus();
    const step = Math.min(this.#step, this.#picture.bars.length - 1);
    this.#step = -1;
    this.setPlayhead(Math.min(this.#secs, layout.time.max), step);
  }

  #begin(press: PointerEvent): Drag | undefined {
    if (!this.#model || !this.#layout) return undefined;
    const target = targetOf(press.target as Element);
    if (!target) return this.#seeking(press);
    if (target.kind === "block") this.#choose(target.index);
    return this.#editing(press, target, this.#layout.stepWidth);
  }

  #seeking(press: PointerEvent): Drag {
    const onSeek = this.#onSeek;
    const { onSettle } = this.#store.gestureListeners;
    const before = this.#secs;
    press.preventDefault();
    this.#playhead.focus();
    const seekTo = (event: PointerEvent) => onSeek(clampedValueAt(this.#layout!.time, this.#xOf(event)));
    seekTo(press);
    return { move: seekTo, cancel: () => onSeek(before), end: onSettle };
  }

  /** A drag of a block, its end, or a transition. All edits start from the blocks before the drag. */
  #editing(press: PointerEvent, { kind, index }: Target, stepWidth: number): Drag {
    const { onSettle, onCancel } = this.#store.gestureListeners;
    const before = this.#store.state.walk;
    const pressX = this.#xOf(press);
    let moved = false;
    const order = { blocks: before, at: index };
    onSettle();
    return {
      move: (event) => {
        moved ||= Math.abs(event.clientX - press.clientX) > CLICK_PX;
        if (!moved) return;
        const steps = (this.#xOf(event) - pressX) / stepWidth;
        if (kind === "end") this.#edit(withBlock(before, index, { steps: before[index]!.steps + steps }), kind, index);
        else if (kind === "block") this.#reorder(event, order);
        else if (index > 0) this.#edit(shiftTransition(before, index, steps), kind);
        else this.#edit(withBlock(before, 0, { transition: before[0]!.transition + steps }), kind);
      },
      cancel: () => {
        onCancel();
        if (kind === "block") this.#choose(index);
      },
      end: onSettle,
    };
  }

  /** Moves the dragged block to the pointer's position. */
  #reorder(event: PointerEvent, order: { blocks: readonly WalkBlock[]; at: number }): void {
    const { blocks, walk } = this.#model!;
    // Positions of blocks are known once they are drawn in their current order.
    if (blocks !== order.blocks) return;
    const x = this.#xOf(event);
    const step = this.#layout!.stepX.findLastIndex((start) => start <= x);
    const to = blockBefore(walk.segments, Math.min(Math.max(0, step), walk.stepStarts.length - 2));
    if (to === order.at) return;
    order.blocks = moveBlock(blocks, order.at, to);
    order.at = to;
    this.#edit(order.blocks, "block", to);
  }

  #xOf(event: PointerEvent): number {
    return placeIn(this.#root, event).x;
  }

  #choose(walkBlock: number): void {
    this.#store.edit({ walkBlock });
  }

  /** Sets new blocks. Edits of one `gesture`, a drag or a run of key presses, are one undo step. */
  #edit(walk: readonly WalkBlock[], gesture: string, chosen?: number): void {
    this.#store.edit({ walk, ...(chosen !== undefined && { walkBlock: chosen }) }, `plan ${gesture}`);
  }

  #onKey(event: KeyboardEvent): void {
    if (!this.#model || event.ctrlKey || event.metaKey || event.altKey) return;
    const target = targetOf(event.target as Element);
    if (!target || !this.#press(target, event.key)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Edits by a key. Returns whether the key has a function here. */
  #press({ kind, index }: Target, key: string): boolean {
    // The displayed blocks may be one display frame old.
    const blocks = this.#store.state.walk;
    const { steps, transition } = blocks[index]!;
    const along = { ArrowRight: 1, ArrowLeft: -1 }[key] ?? 0;
    const up = { ArrowUp: 1, ArrowDown: -1 }[key] ?? 0;
    const by = along + up;
    const end = key === "Home" ? "min" : key === "End" ? "max" : undefined;
    if (kind === "end" && end) this.#edit(withBlock(blocks, index, { steps: STEP_RANGE[end] }), kind, index);
    else if (kind === "middle" && end)
      this.#edit(withBlock(blocks, index, { transition: TRANSITION_RANGE[end] }), kind);
    else if (kind === "end" && by !== 0) this.#edit(withBlock(blocks, index, { steps: steps + by }), kind, index);
    else if (kind === "middle" && along !== 0 && index > 0) this.#edit(shiftTransition(blocks, index, along), kind);
    else if (kind === "middle" && by !== 0) this.#edit(withBlock(blocks, index, { transition: transition + by }), kind);
    else if (kind !== "block") return false;
    else if (along !== 0) {
      const to = index + along;
      if (!blocks[to]) return true;
      this.#edit(moveBlock(blocks, index, to), kind, to);
      this.#focusNext = `block-${to}`;
    } else if (up !== 0) this.#edit(withBlock(blocks, index, { steps: steps + up }), "end", index);
    else if (key === "Enter" || key === " ") this.#choose(index);
    else if (key === "Delete" || key === "Backspace")
      this.#store.edit({ walk: removeBlock(blocks, index), walkBlock: Math.max(0, index - 1) });
    else return false;
    return true;
  }
}

/** The target that an element of the picture belongs to; `undefined` for the ruler, the charts and the playhead. */
function targetOf(element: Element): Target | undefined {
  for (const kind of ["end", "middle", "block"] as const) {
    const index = element.closest<SVGElement>(`[data-${kind}]`)?.dataset[kind];
    if (index !== undefined) return { kind, index: Number(index) };
  }
  return undefined;
}
