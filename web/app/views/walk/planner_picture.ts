/** Draws a plan: blocks and transitions over time, the steps of both feet, and the duration of each state of a step. */

import { formatNumber, svg } from "../../../ui/dom";
import { STEP_RANGE, TRANSITION_RANGE, type WalkBlock } from "../../state/walk";
import { strings } from "../../strings/strings";
import { spoken } from "../../ui/words";
import { timeRuler } from "../synthesis/time_ruler";
import { coloursOf, mixed } from "./colours";
import { mainStyle, type Segment, sharesAt } from "./plan";
import type { PlannedWalk } from "./plan_walker";
import { CHART_HEIGHT, GUTTER, MARGIN, type PlannerLayout, ROWS, STYLE_HEIGHT } from "./planner_layout";

/** Opacity of the states of a step, first to last. */
export const STATE_SHADES = [0.95, 0.74, 0.55, 0.38, 0.24] as const;
/** Minimum distance of two labels of the ruler, units. */
const LABEL_PX = 60;
/** Mean width of a letter of a block's name, units. */
const LETTER_PX = 7;
/** Minimum distance of two step numbers, units. */
const NUMBER_PX = 20;
/** Distance of the two feet's rows, units. */
const FOOT_ROW = 11;

export interface PlannerModel {
  blocks: readonly WalkBlock[];
  chosen: number;
  neutral: string | undefined;
  walk: PlannedWalk;
  title: (block: WalkBlock) => string;
}

/** The elements of a plan. */
export interface PlannerPicture {
  elements: SVGElement[];
  /** The bar and the number of each step. */
  bars: SVGElement[];
  numbers: SVGElement[];
}

export function drawPlan(model: PlannerModel, layout: PlannerLayout): PlannerPicture {
  const colours = coloursOf(model.blocks, model.neutral);
  const { segments } = model.walk;
  const { bars, numbers, tracks } = drawSteps(layout);
  const elements = [
    timeRuler({ time: layout.time, y: ROWS.ruler, labelPx: LABEL_PX, zero: strings.synthesis.zero }),
    // Names and numbers of the drawing are meaningless without it; blocks and handles have labels of their own.
    svg("g", { "aria-hidden": "true" }, ...rowNames()),
    svg("g", { class: "planner-steps", "aria-hidden": "true" }, ...tracks, ...bars, ...numbers),
    durationChart(model.walk, colours, layout),
    ...segments.map((segment) =>
      segment.kind === "block"
        ? drawBlock(segment, colours[segment.block]!, model, layout)
        : drawTransition(segment, colours, model, layout),
    ),
    ...segments.flatMap((segment) => (segment.kind === "block" ? [drawEdge(segment, model, layout)] : [])),
  ];
  return { elements, bars, numbers };
}

function rowNames(): SVGElement[] {
  const { style, stepsRow, left, right, stateDurations } = strings.walk;
  return [
    text({ x: MARGIN, y: ROWS.style + 24, class: "planner-name" }, style),
    text({ x: MARGIN, y: ROWS.steps + 11, class: "planner-name" }, stepsRow),
    text({ x: GUTTER - 14, y: ROWS.steps + 7, "text-anchor": "end" }, left),
    text({ x: GUTTER - 14, y: ROWS.steps + 7 + FOOT_ROW, "text-anchor": "end" }, right),
    text({ x: MARGIN, y: ROWS.heading, class: "planner-name" }, stateDurations),
  ];
}

function drawSteps({ time, stepX, stepWidth }: PlannerLayout) {
  const tracks = [0, 1].map((foot) =>
    svg("rect", {
      class: "planner-track",
      x: time.from,
      y: ROWS.steps + FOOT_ROW * foot,
      width: time.to - time.from,
      height: 6,
    }),
  );
  const every = Math.ceil(NUMBER_PX / stepWidth);
  const starts = stepX.slice(0, -1);
  // A step belongs to the foot that swings; the left one begins.
  const bars = starts.map((x, step) =>
    svg("rect", {
      class: "planner-step",
      x,
      y: ROWS.steps + FOOT_ROW * (step % 2),
      width: stepX[step + 1]! - x - 1,
      height: 6,
    }),
  );
  const numbers = starts.map((x, step) =>
    text(
      { x: (x + stepX[step + 1]!) / 2, y: ROWS.numbers, "text-anchor": "middle" },
      step % every === 0 ? String(step + 1) : "",
    ),
  );
  return { tracks, bars, numbers };
}

/** A stacked bar for each step: its height is the duration of the step, its parts are the states. */
function durationChart(
  { stateSecs, segments }: PlannedWalk,
  colours: readonly string[],
  { time, stepX }: PlannerLayout,
): SVGGElement {
  const group = svg("g", { class: "planner-chart", "aria-hidden": "true" });
  const longest = Math.max(0.4, ...stateSecs.map((states) => states.reduce((sum, secs) => sum + secs, 0)));
  const bottom = ROWS.chart + CHART_HEIGHT;
  const every = longest > 0.9 ? 0.4 : 0.2;
  const y = (secs: number) => bottom - (secs / longest) * CHART_HEIGHT;
  for (let secs = 0; secs <= longest; secs += every) {
    const label = secs === 0 ? strings.synthesis.zero : formatNumber(secs, 1);
    group.append(
      svg("line", { x1: time.from, x2: time.to, y1: y(secs), y2: y(secs) }),
      text({ x: GUTTER - 14, y: y(secs) + 4, "text-anchor": "end" }, label),
    );
  }
  for (const [step, states] of stateSecs.entries()) {
    const x = stepX[step]!;
    let start = 0;
    for (const [state, secs] of states.entries()) {
      const [one, other] = sharesAt(segments, step, (state + 0.5) / states.length);
      const colour = other ? mixed(colours[one!.block]!, colours[other.block]!, other.share) : colours[one!.block]!;
      const top = y(start + secs);
      const bar = svg("rect", {
        x: x + 2,
        y: top + 0.5,
        width: Math.max(1, stepX[step + 1]! - x - 4),
        height: Math.max(1, y(start) - top - 1),
        rx: 1.5,
        "fill-opacity": STATE_SHADES[state]!,
      });
      bar.style.setProperty("fill", colour);
      group.append(bar);
      start += secs;
    }
  }
  return group;
}

function drawBlock(
  { block: index, first, steps }: Segment & { kind: "block" },
  colour: string,
  { blocks, chosen, title }: PlannerModel,
  { stepX }: PlannerLayout,
): SVGGElement {
  const block = blocks[index]!;
  const [x, end] = [stepX[first]!, stepX[first + steps]!];
  const width = Math.max(8, end - x - 1);
  const name = title(block);
  const count = strings.walk.blockSteps(steps);
  const y = ROWS.style;
  const group = coloured(
    colour,
    svg("g", {
      class: "planner-block",
      role: "button",
      tabindex: 0,
      "data-key": `block-${index}`,
      "data-block": index,
      "aria-pressed": index === chosen ? "true" : "false",
      "aria-label": strings.walk.blockLabel(index + 1, name, count),
      "aria-description": strings.walk.blockKeys,
    }),
  );
  const focus = { x: x + 1, y: y + 1, width: width - 2, height: STYLE_HEIGHT - 2, rx: 3 };
  group.append(
    svg("rect", { class: "planner-fill", x, y, width, height: STYLE_HEIGHT, rx: 3 }),
    svg("rect", { class: "planner-edge", x, y, width: 3, height: STYLE_HEIGHT }),
    svg("rect", { class: "planner-focus", ...focus }),
  );
  // A name that does not fit is in the tooltip only.
  const letters = Math.floor((width - 20) / LETTER_PX);
  const shown = [name, spoken(mainStyle(block))].find((words) => words.length <= letters && name.includes(words)) ?? "";
  if (shown) group.append(text({ x: x + 13, y: y + 25, class: "planner-style" }, shown));
  if (width > LETTER_PX * (shown.length + count.length) + 34)
    group.append(" ", text({ x: end - 12, y: y + 25, "text-anchor": "end" }, count));
  group.append(svg("title", {}, `${name}, ${count}`));
  return group;
}

function drawTransition(
  { from, to, first, steps }: Segment & { kind: "transition" },
  colours: readonly string[],
  { blocks, title }: PlannerModel,
  { stepX }: PlannerLayout,
): SVGGElement {
  const [x, end] = [stepX[first]!, stepX[first + steps]!];
  const [top, bottom] = [ROWS.style + 1, ROWS.style + STYLE_HEIGHT - 1];
  const group = svg("g", { class: "planner-transition" });
  const middle = (x + end) / 2;
  const over = strings.walk.over(steps);
  if (steps > 0) {
    const curve = (a: number, b: number) => `M${x} ${a}C${middle} ${a} ${middle} ${b} ${end} ${b}`;
    const area = `${curve(top, bottom)}L${x} ${bottom}C${middle} ${bottom} ${middle} ${top} ${end} ${top}Z`;
    group.append(
      coloured(mixed(colours[from]!, colours[to]!, 0.5), svg("path", { class: "planner-between", d: area })),
      coloured(colours[from]!, svg("path", { class: "planner-curve", d: curve(top, bottom) })),
      coloured(colours[to]!, svg("path", { class: "planner-curve", d: curve(bottom, top) })),
    );
    if (end - x > 64)
      group.append(text({ x: middle, y: ROWS.caption, "text-anchor": "middle", "aria-hidden": "true" }, over));
  }
  const y = (top + bottom) / 2;
  const tooltip = to === 0 ? strings.walk.backTo(over, title(blocks[0]!)) : over;
  const handle = {
    class: "planner-middle",
    role: "slider",
    tabindex: 0,
    "data-key": `middle-${to}`,
    "data-middle": to,
    "aria-label": strings.walk.middle(to + 1),
    "aria-description": strings.walk.middleKeys,
    "aria-valuemin": TRANSITION_RANGE.min,
    "aria-valuemax": TRANSITION_RANGE.max,
    "aria-valuenow": steps,
    // Left and Right do not change the length. With the position in the text, screen readers announce the move.
    "aria-valuetext": to === 0 ? tooltip : strings.walk.overFrom(over, first + 1),
    "aria-orientation": "vertical",
  };
  group.append(
    svg(
      "g",
      handle,
      svg("circle", { class: "planner-target", cx: middle, cy: y, r: 14 }),
      svg("circle", { class: "planner-ring", cx: middle, cy: y, r: 9 }),
      svg("circle", { class: "planner-dot", cx: middle, cy: y, r: 4 }),
      svg("title", {}, tooltip),
    ),
  );
  return group;
}

/** The right end of a block, which changes its number of steps. */
function drawEdge(
  { block: index, first, steps }: Segment & { kind: "block" },
  { blocks, chosen }: PlannerModel,
  { stepX }: PlannerLayout,
): SVGGElement {
  const x = stepX[first + steps]!;
  const y = ROWS.style;
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
      "aria-valuetext": strings.walk.blockSteps(blocks[index]!.steps),
    },
    svg("rect", { class: "planner-target", x: x - 10, y, width: 14, height: STYLE_HEIGHT }),
    svg("rect", { class: "planner-grip", x: x - 4, y: y + 10, width: 4, height: 20, rx: 2 }),
  );
}

/** Sets the colour in which the style sheet draws an element. */
function coloured<E extends SVGElement>(colour: string, element: E): E {
  element.style.setProperty("--colour", colour);
  return element;
}

function text(attributes: Record<string, string | number>, content: string): SVGTextElement {
  return svg("text", attributes, content);
}
