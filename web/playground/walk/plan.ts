/**
 * The plan of a walk: blocks of styles on a row of steps, and transitions between them. Pure edits of plain data; the URL, the
 * planner and the walker all speak in plans.
 */
import type { Selection } from "../polygon/selection";

/** Some steps in one mixture of styles, or in one for each foot. */
export interface WalkBlock {
  styles: Selection;
  /** What the steps of the right foot are in, where {@link styles} is of the left foot's only. */
  right?: Selection | undefined;
  /** What the styles' weights are multiplied by: 0 is the average of all styles, above 1 exaggerates, below 0 is the opposite. */
  intensity: number;
  /** Steps that are all in this mixture, at least 1. */
  steps: number;
  /** Steps in between that lead into it. */
  transition: number;
}

export const MOST_BLOCKS = 12;
export const STEP_RANGE = { min: 1, max: 16, digits: 0 } as const;
export const TRANSITION_RANGE = { min: 0, max: 8, digits: 0 } as const;
export const INTENSITY_RANGE = { min: -2, max: 3, digits: 2 } as const;
/** Steps of a new block, and those that lead into it: with four, no joint is pushed harder than in steady walking. */
const NEW_BLOCK = { intensity: 1, steps: 4, transition: 4 };

/** A stretch of the row of steps: a block, or the way from one to the next. */
export type Segment =
  | { kind: "block"; block: number; first: number; steps: number }
  | { kind: "transition"; from: number; to: number; first: number; steps: number };

/** The row of steps that blocks make up; where it begins again, it ends with the way back to the first block. */
export function segmentsOf(blocks: readonly WalkBlock[], loop: boolean): Segment[] {
  const segments: Segment[] = [];
  let first = 0;
  const add = (segment: Segment) => {
    segments.push(segment);
    first += segment.steps;
  };
  for (const [i, block] of blocks.entries()) {
    if (i > 0) add({ kind: "transition", from: i - 1, to: i, first, steps: block.transition });
    add({ kind: "block", block: i, first, steps: block.steps });
  }
  if (loop && blocks.length > 1)
    add({ kind: "transition", from: blocks.length - 1, to: 0, first, steps: blocks[0]!.transition });
  return segments;
}

/** Steps of a row. */
export function stepsOf(segments: readonly Segment[]): number {
  return segments.reduce((sum, { steps }) => sum + steps, 0);
}

/** The segment that a step is in; steps beyond the row are in its last one. */
export function segmentAt(segments: readonly Segment[], step: number): Segment {
  return segments.find(({ first, steps }) => step >= first && step < first + steps) ?? segments.at(-1)!;
}

/** How much of each block a moment of a step is, 0.5 being its middle: one of them, or two on the way. */
export function sharesAt(segments: readonly Segment[], step: number, moment = 0.5): { block: number; share: number }[] {
  const segment = segmentAt(segments, step);
  if (segment.kind === "block") return [{ block: segment.block, share: 1 }];
  const share = (step - segment.first + moment) / segment.steps;
  return [
    { block: segment.from, share: 1 - share },
    { block: segment.to, share },
  ];
}

/** A change of the style that is walked in, to a block's. */
export interface PlannedChange {
  /** The first step in between. */
  step: number;
  between: number;
  block: number;
}

/** The changes of one time through the row, counted from the step that it begins at. */
export function changesOf(segments: readonly Segment[], begin: number): PlannedChange[] {
  return segments.flatMap((segment) =>
    segment.kind === "transition" ? [{ step: begin + segment.first, between: segment.steps, block: segment.to }] : [],
  );
}

/** The block whose style a step is in, or comes from. */
export function blockBefore(segments: readonly Segment[], step: number): number {
  const segment = segmentAt(segments, step);
  return segment.kind === "block" ? segment.block : segment.from;
}

const clamped = (value: number, { min, max }: { min: number; max: number }) =>
  Math.min(max, Math.max(min, Math.round(value)));

/** The blocks with one of them changed; counts are kept in their ranges. */
export function withBlock(blocks: readonly WalkBlock[], index: number, patch: Partial<WalkBlock>): WalkBlock[] {
  return blocks.map((block, i) => {
    if (i !== index) return block;
    const { steps, transition, ...rest } = { ...block, ...patch };
    return { ...rest, steps: clamped(steps, STEP_RANGE), transition: clamped(transition, TRANSITION_RANGE) };
  });
}

/** Gives steps of a block to its neighbour across a transition, or takes some, so that only the transition moves. */
export function shiftTransition(blocks: readonly WalkBlock[], to: number, by: number): WalkBlock[] {
  const [before, after] = [blocks[to - 1], blocks[to]];
  if (!before || !after) return [...blocks];
  const { min, max } = STEP_RANGE;
  const least = Math.max(min - before.steps, after.steps - max);
  const most = Math.min(max - before.steps, after.steps - min);
  const shift = Math.min(most, Math.max(least, Math.round(by)));
  return withBlock(withBlock(blocks, to - 1, { steps: before.steps + shift }), to, { steps: after.steps - shift });
}

/** The blocks with one of them at another place. */
export function moveBlock(blocks: readonly WalkBlock[], from: number, to: number): WalkBlock[] {
  const rest = blocks.filter((_, i) => i !== from);
  rest.splice(to, 0, blocks[from]!);
  return rest;
}

/** The blocks with another one after that of an index. */
export function addBlock(blocks: readonly WalkBlock[], after: number, styles: Selection): WalkBlock[] {
  const added: WalkBlock = { ...NEW_BLOCK, styles };
  return [...blocks.slice(0, after + 1), added, ...blocks.slice(after + 1)];
}

/** The blocks without one of them; the last one stays. */
export function removeBlock(blocks: readonly WalkBlock[], index: number): WalkBlock[] {
  return blocks.length < 2 ? [...blocks] : blocks.filter((_, i) => i !== index);
}

/** The blocks to begin with: the neutral style, and two that differ from it. */
export function firstBlocks(styles: readonly string[], neutral: string | undefined): WalkBlock[] {
  const others = styles.filter((name) => name !== neutral);
  const chosen = [
    ...(neutral !== undefined && styles.includes(neutral) ? [neutral] : []),
    ...["proud", "old"].filter((name) => others.includes(name)),
    ...others.filter((name) => name !== "proud" && name !== "old"),
  ].slice(0, 3);
  const lengths = [3, 4, 3];
  return chosen.map((name, i) => ({
    styles: [{ name, weight: 1 }],
    intensity: 1,
    steps: lengths[i]!,
    transition: NEW_BLOCK.transition,
  }));
}

/**
 * The blocks with only the styles that there are; `undefined` where nothing had to go. A block that loses all that it was of
 * becomes neutral, or goes too where there is no neutral style.
 */
export function withKnownStyles(
  blocks: readonly WalkBlock[],
  known: readonly string[],
  neutral: string | undefined,
): WalkBlock[] | undefined {
  const isKnown = ({ name }: { name: string }) => known.includes(name);
  if (blocks.every(({ styles, right }) => styles.every(isKnown) && (right ?? []).every(isKnown))) return undefined;
  const kept = (styles: Selection): Selection | undefined => {
    const some = styles.filter(isKnown);
    if (some.some((s) => s.weight !== 0)) return some;
    return neutral === undefined ? undefined : [{ name: neutral, weight: 1 }];
  };
  return blocks.flatMap((block) => {
    const styles = kept(block.styles);
    return styles ? { ...block, styles, right: block.right && kept(block.right) } : [];
  });
}

/** The style that a block has most of. */
export function mainStyle({ styles }: WalkBlock): string {
  return styles.reduce((a, b) => (Math.abs(b.weight) > Math.abs(a.weight) ? b : a)).name;
}
