/** The planner: blocks of styles on a row of time, the steps that they make, and how long each state of them lasts. */
import { formatNumber, html, setAttributes, svg } from "../dom";
import { strings } from "../strings/strings";
import { spoken } from "../words";
import { coloursOf, mixed } from "./colours";
import {
  blockBefore,
  mainStyle,
  moveBlock,
  removeBlock,
  type Segment,
  STEP_RANGE,
  sharesAt,
  shiftTransition,
  TRANSITION_RANGE,
  type WalkBlock,
  withBlock,
} from "./plan";
import type { Walked } from "./walking";

/** Room for the names of the rows, and to the right, pixels. */
const GUTTER = 88;
const MARGIN = 20;
/** From the top, pixels. */
const ROWS = { ruler: 22, caption: 38, style: 46, steps: 110, numbers: 140, heading: 166, chart: 184, height: 284 };
const STYLE_HEIGHT = 40;
const CHART_HEIGHT = 92;
/** States from the first to the last, how much of the style's colour each has. */
const SHADES = [0.95, 0.74, 0.55, 0.38, 0.24];
/** A press that moves farther than this drags, pixels. */
const CLICK_PX = 4;
/** Seconds on the ruler are so far apart at least, pixels. */
const LEAST_TICK = 44;

export interface PlannerListeners {
  /** The blocks as they are now: those that are drawn are a frame of the screen old. */
  blocks: () => readonly WalkBlock[];
  onChoose: (block: number) => void;
  /** New blocks; `gesture` names the drag or run of key presses that they belong to, `chosen` the block that is chosen then. */
  onEdit: (blocks: readonly WalkBlock[], gesture?: string, chosen?: number) => void;
  onSettle: () => void;
  onSeek: (secs: number) => void;
}

export interface PlannerModel {
  blocks: readonly WalkBlock[];
  chosen: number;
  neutral: string | undefined;
  walked: Walked;
  title: (block: WalkBlock) => string;
}

interface Drag {
  pointerId: number;
  kind: "seek" | "move" | "edge" | "middle";
  block: number;
  x: number;
  moved: boolean;
  /** The blocks as they were or, where their order changes, as they were last put; and pixels of a step. */
  blocks: readonly WalkBlock[];
  stepWidth: number;
}

export class Planner {
  readonly element: HTMLElement;
  readonly #listeners: PlannerListeners;
  readonly #root = svg("svg", { class: "planner", role: "group", "aria-label": strings.walk.plan });
  readonly #picture = svg("g");
  readonly #head: SVGGElement;
  #model: PlannerModel | undefined;
  #secs = 0;
  #step = -1;
  #stepBars: SVGElement[] = [];
  #stepNumbers: SVGElement[] = [];
  #drag: Drag | undefined;
  /** What has the keyboard once the change is drawn. */
  #focusNext: string | undefined;

  constructor(listeners: PlannerListeners) {
    this.#listeners = listeners;
    this.#head = svg(
      "g",
      { class: "maker-head", role: "slider", tabindex: 0, "aria-label": strings.walk.time, "aria-valuemin": 0 },
      svg("line", { y1: ROWS.ruler - 6, y2: ROWS.chart + CHART_HEIGHT }),
      svg("path", { d: `M-6 ${ROWS.ruler - 16}h12v9l-6 6-6-6z` }),
    );
    this.#root.append(this.#picture, this.#head);
    this.element = html("div", { class: "planner-box" }, this.#root);
    this.#root.addEventListener("pointerdown", (event) => this.#onPointerDown(event));
    this.#root.addEventListener("pointermove", (event) => this.#onPointerMove(event));
    for (const type of ["pointerup", "pointercancel"] as const)
      this.#root.addEventListener(type, (event) => this.#onPointerEnd(event));
    this.#root.addEventListener("keydown", (event) => this.#onKey(event));
    this.#root.addEventListener("keyup", () => listeners.onSettle());
    new ResizeObserver(() => this.#draw()).observe(this.element);
  }

  show(model: PlannerModel): void {
    this.#model = model;
    this.#draw();
  }

  /** Puts the playhead at a time of the plan, in one of its steps. */
  setPlayhead(secs: number, step: number): void {
    this.#secs = secs;
    this.#head.setAttribute("transform", `translate(${this.#x(secs).toFixed(1)} 0)`);
    if (step === this.#step) return;
    const mark = (index: number, on: boolean) => {
      this.#stepBars[index]?.classList.toggle("present", on);
      this.#stepNumbers[index]?.classList.toggle("present", on);
    };
    mark(this.#step, false);
    mark(step, true);
    this.#step = step;
    setAttributes(this.#head, {
      "aria-valuenow": formatNumber(secs, 2),
      "aria-valuemax": formatNumber(this.#duration, 2),
      "aria-valuetext": `${formatNumber(secs, 1)} s, ${strings.walk.stepCaption(step + 1)}`,
    });
  }

  get #duration(): number {
    const { walked } = this.#model ?? {};
    return walked ? walked.frames / walked.rateHz : 1;
  }

  get #width(): number {
    return Math.max(320, this.element.clientWidth);
  }

  #x(secs: number): number {
    return GUTTER + (secs / this.#duration) * (this.#width - GUTTER - MARGIN);
  }

  /** Where a step begins, pixels. */
  #stepX(step: number): number {
    const { begins, rateHz } = this.#model!.walked;
    return this.#x(begins[Math.min(step, begins.length - 1)]! / rateHz);
  }

  #draw(): void {
    if (!this.#model) return;
    const width = this.#width;
    setAttributes(this.#root, { viewBox: `0 0 ${width} ${ROWS.height}`, width, height: ROWS.height });
    const active = document.activeElement;
    const held = active instanceof SVGElement && this.#picture.contains(active) ? active.dataset.key : undefined;
    const focused = held === undefined ? undefined : (this.#focusNext ?? held);
    this.#focusNext = undefined;
    const colours = coloursOf(this.#model.blocks, this.#model.neutral);
    this.#picture.replaceChildren(
      this.#ruler(),
      ...this.#names(),
      this.#steps(),
      this.#chart(colours),
      ...this.#model.walked.segments.map((segment) =>
        segment.kind === "block" ? this.#block(segment, colours) : this.#transition(segment, colours),
      ),
      ...this.#edges(),
    );
    if (focused) this.#picture.querySelector<SVGElement>(`[data-key="${focused}"]`)?.focus();
    const step = this.#step;
    this.#step = -1;
    this.setPlayhead(Math.min(this.#secs, this.#duration), Math.min(step, this.#stepBars.length - 1));
  }

  #ruler(): SVGGElement {
    const group = svg("g", { class: "planner-ruler", "aria-hidden": "true" });
    const y = ROWS.ruler;
    group.append(
      svg("rect", { class: "planner-seek", x: GUTTER, width: this.#width - GUTTER - MARGIN, height: y + 6 }),
    );
    group.append(svg("line", { x1: GUTTER, x2: this.#width - MARGIN, y1: y, y2: y }));
    const every = [1, 2, 5, 10, 20, 60].find((secs) => this.#x(secs) - this.#x(0) > LEAST_TICK) ?? 60;
    for (let secs = 0; secs <= this.#duration; secs += every) {
      const x = this.#x(secs);
      group.append(svg("line", { x1: x, x2: x, y1: y - 5, y2: y }));
      group.append(
        text(
          { x: secs === 0 ? x + 8 : x, y: y - 9, "text-anchor": secs === 0 ? "start" : "middle" },
          secs === 0 ? strings.walk.zero : String(secs),
        ),
      );
    }
    return group;
  }

  #names(): SVGElement[] {
    const { left, right } = strings.walk;
    return [
      text({ x: MARGIN, y: ROWS.style + 24, class: "planner-name" }, strings.walk.style),
      text({ x: MARGIN, y: ROWS.steps + 11, class: "planner-name" }, strings.walk.stepsRow),
      text({ x: GUTTER - 14, y: ROWS.steps + 7, "text-anchor": "end" }, left),
      text({ x: GUTTER - 14, y: ROWS.steps + 18, "text-anchor": "end" }, right),
      text({ x: MARGIN, y: ROWS.heading, class: "planner-name" }, strings.walk.stateDurations),
    ];
  }

  #block(segment: Segment & { kind: "block" }, colours: readonly string[]): SVGGElement {
    const { blocks, chosen, title } = this.#model!;
    const { block: index, first, steps } = segment;
    const block = blocks[index]!;
    const [x, end] = [this.#stepX(first), this.#stepX(first + steps)];
    const width = Math.max(8, end - x - 1);
    const name = title(block);
    const count = strings.walk.blockSteps(steps);
    const group = svg("g", {
      class: "planner-block",
      role: "button",
      tabindex: 0,
      "data-key": `block-${index}`,
      "data-block": index,
      "aria-pressed": index === chosen ? "true" : "false",
      "aria-label": strings.walk.blockLabel(index + 1, name, count),
      style: `--colour: ${colours[index]}`,
    });
    group.append(
      svg("rect", { class: "planner-fill", x, y: ROWS.style, width, height: STYLE_HEIGHT, rx: 3 }),
      svg("rect", { class: "planner-edge", x, y: ROWS.style, width: 3, height: STYLE_HEIGHT }),
      svg("rect", {
        class: "planner-focus",
        x: x + 1,
        y: ROWS.style + 1,
        width: width - 2,
        height: STYLE_HEIGHT - 2,
        rx: 3,
      }),
    );
    // Names that do not fit are left to the tooltip.
    const letters = Math.floor((width - 20) / 7);
    const shown =
      [name, spoken(mainStyle(block))].find((words) => words.length <= letters && name.includes(words)) ?? "";
    if (shown) group.append(text({ x: x + 13, y: ROWS.style + 25, class: "planner-style" }, shown));
    if (width > 7 * (shown.length + count.length) + 34)
      group.append(" ", text({ x: end - 12, y: ROWS.style + 25, "text-anchor": "end" }, count));
    group.append(svg("title", {}, `${name}, ${count}`));
    return group;
  }

  #transition(segment: Segment & { kind: "transition" }, colours: readonly string[]): SVGGElement {
    const { from, to, first, steps } = segment;
    const [x, end] = [this.#stepX(first), this.#stepX(first + steps)];
    const [top, bottom] = [ROWS.style + 1, ROWS.style + STYLE_HEIGHT - 1];
    const group = svg("g", { class: "planner-transition" });
    const middle = (x + end) / 2;
    const over = strings.walk.over(steps);
    if (steps > 0) {
      const curve = (a: number, b: number) => `M${x} ${a}C${middle} ${a} ${middle} ${b} ${end} ${b}`;
      group.append(
        svg("path", {
          class: "planner-between",
          d: `${curve(top, bottom)}L${x} ${bottom}C${middle} ${bottom} ${middle} ${top} ${end} ${top}Z`,
          style: `--colour: ${mixed(colours[from]!, colours[to]!, 0.5)}`,
        }),
        svg("path", { class: "planner-curve", d: curve(top, bottom), style: `--colour: ${colours[from]}` }),
        svg("path", { class: "planner-curve", d: curve(bottom, top), style: `--colour: ${colours[to]}` }),
      );
      if (end - x > 64) group.append(text({ x: middle, y: ROWS.caption, "text-anchor": "middle" }, over));
    }
    const y = (top + bottom) / 2;
    const back = to === 0;
    const said = back ? strings.walk.backTo(over, this.#model!.title(this.#model!.blocks[0]!)) : over;
    group.append(
      svg(
        "g",
        {
          class: "planner-middle",
          role: "slider",
          tabindex: 0,
          "data-key": `middle-${to}`,
          "data-middle": to,
          "aria-label": strings.walk.middle(to + 1),
          "aria-valuemin": TRANSITION_RANGE.min,
          "aria-valuemax": TRANSITION_RANGE.max,
          "aria-valuenow": steps,
          "aria-valuetext": said,
          "aria-orientation": "vertical",
        },
        svg("circle", { class: "planner-target", cx: middle, cy: y, r: 14 }),
        svg("circle", { class: "planner-ring", cx: middle, cy: y, r: 9 }),
        svg("circle", { class: "planner-dot", cx: middle, cy: y, r: 4 }),
        svg("title", {}, said),
      ),
    );
    return group;
  }

  /** The right ends of the blocks, which change their numbers of steps. */
  #edges(): SVGElement[] {
    const { blocks, walked, chosen } = this.#model!;
    return walked.segments.flatMap((segment) => {
      if (segment.kind !== "block") return [];
      const { block: index, first, steps } = segment;
      const x = this.#stepX(first + steps);
      const grip = svg("rect", { class: "planner-grip", x: x - 4, y: ROWS.style + 10, width: 4, height: 20, rx: 2 });
      const target = svg("rect", {
        class: "planner-target",
        x: x - 10,
        y: ROWS.style,
        width: 14,
        height: STYLE_HEIGHT,
      });
      return svg(
        "g",
        {
          class: index === chosen ? "planner-end chosen" : "planner-end",
          role: "slider",
          tabindex: 0,
          "data-key": `end-${index}`,
          "data-end": index,
          "aria-label": strings.walk.edge(index + 1),
          "aria-valuemin": STEP_RANGE.min,
          "aria-valuemax": STEP_RANGE.max,
          "aria-valuenow": blocks[index]!.steps,
        },
        target,
        grip,
      );
    });
  }

  #steps(): SVGGElement {
    const { begins } = this.#model!.walked;
    const group = svg("g", { class: "planner-steps" });
    const end = this.#width - MARGIN;
    for (const row of [0, 1])
      group.append(
        svg("rect", { class: "planner-track", x: GUTTER, y: ROWS.steps + 11 * row, width: end - GUTTER, height: 6 }),
      );
    this.#stepBars = [];
    this.#stepNumbers = [];
    const every = Math.ceil(20 / ((end - GUTTER) / (begins.length - 1)));
    for (let step = 0; step < begins.length - 1; step++) {
      const [x, next] = [this.#stepX(step), this.#stepX(step + 1)];
      // A step is that of the foot that swings; the left one begins.
      const row = step % 2;
      const bar = svg("rect", { class: "planner-step", x, y: ROWS.steps + 11 * row, width: next - x - 1, height: 6 });
      const number = text(
        { x: (x + next) / 2, y: ROWS.numbers, "text-anchor": "middle" },
        step % every === 0 ? String(step + 1) : "",
      );
      this.#stepBars.push(bar);
      this.#stepNumbers.push(number);
      group.append(bar, number);
    }
    return group;
  }

  #chart(colours: readonly string[]): SVGGElement {
    const { walked } = this.#model!;
    const { durations, segments } = walked;
    const group = svg("g", { class: "planner-chart" });
    const longest = Math.max(0.4, ...durations.map((states) => states.reduce((sum, secs) => sum + secs, 0)));
    const bottom = ROWS.chart + CHART_HEIGHT;
    const every = longest > 0.9 ? 0.4 : 0.2;
    const y = (secs: number) => bottom - (secs / longest) * CHART_HEIGHT;
    for (let secs = 0; secs <= longest; secs += every) {
      group.append(svg("line", { x1: GUTTER, x2: this.#width - MARGIN, y1: y(secs), y2: y(secs) }));
      const said = secs === 0 ? strings.walk.zero : formatNumber(secs, 1);
      group.append(text({ x: GUTTER - 14, y: y(secs) + 4, "text-anchor": "end" }, said));
    }
    for (const [step, states] of durations.entries()) {
      const [x, next] = [this.#stepX(step), this.#stepX(step + 1)];
      let from = 0;
      for (const [state, secs] of states.entries()) {
        const [one, other] = sharesAt(segments, step, (state + 0.5) / states.length);
        const colour = other ? mixed(colours[one!.block]!, colours[other.block]!, other.share) : colours[one!.block]!;
        const top = y(from + secs);
        group.append(
          svg("rect", {
            x: x + 2,
            y: top + 0.5,
            width: Math.max(1, next - x - 4),
            height: Math.max(1, y(from) - top - 1),
            rx: 1.5,
            style: `fill: ${colour}`,
            "fill-opacity": SHADES[state]!,
          }),
        );
        from += secs;
      }
    }
    return group;
  }

  #onPointerDown(event: PointerEvent): void {
    if (event.button !== 0 || this.#drag || !this.#model) return;
    const target = event.target as Element;
    const number = (name: string) => {
      const value = target.closest<SVGElement>(`[data-${name}]`)?.dataset[name];
      return value === undefined ? undefined : Number(value);
    };
    const [block, end, middle] = [number("block"), number("end"), number("middle")];
    const kind = end !== undefined ? "edge" : middle !== undefined ? "middle" : block !== undefined ? "move" : "seek";
    const index = end ?? middle ?? block ?? 0;
    const { walked } = this.#model;
    const blocks = this.#listeners.blocks();
    const stepWidth = (this.#width - GUTTER - MARGIN) / Math.max(1, walked.begins.length - 1);
    this.#root.setPointerCapture(event.pointerId);
    this.#drag = { pointerId: event.pointerId, kind, block: index, x: event.clientX, moved: false, blocks, stepWidth };
    if (kind === "seek") {
      event.preventDefault();
      this.#seekTo(event);
    } else if (kind === "move") this.#listeners.onChoose(index);
  }

  #onPointerMove(event: PointerEvent): void {
    const drag = this.#drag;
    if (event.pointerId !== drag?.pointerId || !this.#model) return;
    const dx = event.clientX - drag.x;
    drag.moved ||= Math.abs(dx) > CLICK_PX;
    if (drag.kind === "seek") this.#seekTo(event);
    else if (drag.moved) {
      const by = dx / drag.stepWidth;
      const before = drag.blocks[drag.block]!;
      if (drag.kind === "edge")
        this.#edit(withBlock(drag.blocks, drag.block, { steps: before.steps + by }), "edge", drag.block);
      else if (drag.kind === "middle" && drag.block > 0)
        this.#edit(shiftTransition(drag.blocks, drag.block, by), "middle");
      else if (drag.kind === "middle")
        this.#edit(withBlock(drag.blocks, 0, { transition: before.transition + by }), "middle");
      else this.#moveTo(event, drag);
    }
  }

  #onPointerEnd(event: PointerEvent): void {
    if (event.pointerId !== this.#drag?.pointerId) return;
    this.#drag = undefined;
    this.#listeners.onSettle();
  }

  #seekTo(event: PointerEvent): void {
    const x = event.clientX - this.#root.getBoundingClientRect().left;
    const share = (x - GUTTER) / (this.#width - GUTTER - MARGIN);
    this.#listeners.onSeek(Math.min(1, Math.max(0, share)) * this.#duration);
  }

  /** Several keys may be pressed before the playhead is drawn again. */
  #seek(secs: number): void {
    this.#secs = Math.min(this.#duration, Math.max(0, secs));
    this.#listeners.onSeek(this.#secs);
  }

  /** Brings the block that is dragged to where the pointer is. */
  #moveTo(event: PointerEvent, drag: Drag): void {
    const { blocks, walked } = this.#model!;
    // Where blocks are is known once they are drawn in their present order.
    if (blocks !== drag.blocks) return;
    const x = event.clientX - this.#root.getBoundingClientRect().left;
    const step = walked.begins.findLastIndex((_, i) => this.#stepX(i) <= x);
    const to = blockBefore(walked.segments, Math.min(Math.max(0, step), walked.begins.length - 2));
    if (to === drag.block) return;
    drag.blocks = moveBlock(blocks, drag.block, to);
    drag.block = to;
    this.#listeners.onEdit(drag.blocks, `move ${drag.pointerId}`, to);
  }

  #edit(blocks: WalkBlock[], gesture: string, chosen?: number): void {
    this.#listeners.onEdit(blocks, `plan ${gesture}`, chosen);
  }

  #onKey(event: KeyboardEvent): void {
    if (!this.#model || event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as SVGElement;
    const blocks = this.#listeners.blocks();
    const { block, end, middle } = target.dataset;
    const along = { ArrowRight: 1, ArrowLeft: -1 }[event.key] ?? 0;
    const up = { ArrowUp: 1, ArrowDown: -1 }[event.key] ?? 0;
    let handled = along !== 0 || up !== 0;
    if (target === this.#head) {
      if (along + up !== 0) this.#seek(this.#secs + 0.1 * (along + up));
      else if (event.key === "Home") this.#seek(0);
      else if (event.key === "End") this.#seek(this.#duration);
      handled ||= event.key === "Home" || event.key === "End";
    } else if (end !== undefined) {
      const index = Number(end);
      if (handled) this.#edit(withBlock(blocks, index, { steps: blocks[index]!.steps + along + up }), "edge", index);
    } else if (middle !== undefined) {
      const index = Number(middle);
      const { transition } = blocks[index]!;
      if (along !== 0 && index > 0) this.#edit(shiftTransition(blocks, index, along), "middle");
      else if (handled) this.#edit(withBlock(blocks, index, { transition: transition + along + up }), "middle");
    } else if (block !== undefined) {
      const index = Number(block);
      const to = index + along;
      if (along !== 0 && blocks[to]) {
        this.#edit(moveBlock(blocks, index, to), "move", to);
        this.#focusNext = `block-${to}`;
      } else if (up !== 0) this.#edit(withBlock(blocks, index, { steps: blocks[index]!.steps + up }), "edge", index);
      else if (event.key === "Enter" || event.key === " ") this.#listeners.onChoose(index);
      else if (event.key === "Delete" || event.key === "Backspace")
        this.#listeners.onEdit(removeBlock(blocks, index), undefined, Math.max(0, index - 1));
      handled ||= ["Enter", " ", "Delete", "Backspace"].includes(event.key);
    } else return;
    if (!handled) return;
    event.preventDefault();
    event.stopPropagation();
  }
}

function text(attributes: Record<string, string | number>, content: string): SVGTextElement {
  return svg("text", attributes, content);
}
