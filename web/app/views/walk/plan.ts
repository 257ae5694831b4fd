/**
 * The plan of a walk: a sequence of steps in blocks of one mixture of styles, with transitions between them. Pure edits of
 * plain data, which the URL, the planner and the walker share.
 */

import type { Selection } from "../../../ui/polygon/selection";
import { STEP_RANGE, TRANSITION_RANGE, type WalkBlock } from "../../state/walk";

/** A new block. In a transition over four steps no joint accelerates more than in steady walking. */
const NEW_BLOCK = { intensity: 1, steps: 4, transition: 4 };

/** Consecutive steps of the plan: those of a block, or of a transition to the next one. */
export type Segment =
  | { kind: "block"; block: number; first: number; steps: number }
  | { kind: "transition"; from: number; to: number; first: number; steps: number };

/** The steps of blocks and their transitions; a looping plan ends with the transition to its first block. */
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

/** Number of all steps. */
export function stepsOf(segments: readonly Segment[]): number {
  return segments.reduce((sum, { steps }) => sum + steps, 0);
}

/** The segment of a step; steps beyond the plan belong to its last one. */
function segmentAt(segments: readonly Segment[], step: number): Segment {
  return segments.find(({ first, steps }) => step >= first && step < first + steps) ?? segments.at(-1)!;
}

/** The blocks whose styles a step mixes, and their shares, at a phase of the step from 0 to 1. */
export function sharesAt(segments: readonly Segment[], step: number, phase = 0.5): { block: number; share: number }[] {
  const segment = segmentAt(segments, step);
  if (segment.kind === "block") return [{ block: segment.block, share: 1 }];
  const share = (step - segment.first + phase) / segment.steps;
  return [
    { block: segment.from, share: 1 - share },
    { block: segment.to, share },
  ];
}

/** A transition to the style of a block. */
interface PlannedChange {
  /** Its first step. */
  step: number;
  between: number;
  block: number;
}

/** The transitions of one pass through the plan, which begins at a step of the walker. */
export function changesOf(segments: readonly Segment[], begin: number): PlannedChange[] {
  return segments.flatMap((segment) =>
    segment.kind === "transition" ? [{ step: begin + segment.first, between: segment.steps, block: segment.to }] : [],
  );
}

/** The block of a step; within a transition the previous one. */
export function blockBefore(segments: readonly Segment[], step: number): number {
  const segment = segmentAt(segments, step);
  return segment.kind === "block" ? segment.block : segment.from;
}

const clamped = (value: number, { min, max }: { min: number; max: number }) =>
  Math.min(max, Math.max(min, Math.round(value)));

/** The blocks with one of them changed; counts are clamped to their ranges. */
export function withBlock(blocks: readonly WalkBlock[], index: number, patch: Partial<WalkBlock>): WalkBlock[] {
  return blocks.map((block, i) => {
    if (i !== index) return block;
    const { steps, transition, ...rest } = { ...block, ...patch };
    return { ...rest, steps: clamped(steps, STEP_RANGE), transition: clamped(transition, TRANSITION_RANGE) };
  });
}

/** Moves a transition by some steps: one of its neighbours gains them and the other one loses them. */
export function shiftTransition(blocks: readonly WalkBlock[], to: number, by: number): WalkBlock[] {
  const [before, after] = [blocks[to - 1], blocks[to]];
  if (!before || !after) return [...blocks];
  const { min, max } = STEP_RANGE;
  const range = {
    min: Math.max(min - before.steps, after.steps - max),
    max: Math.min(max - before.steps, after.steps - min),
  };
  const shift = clamped(by, range);
  return withBlock(withBlock(blocks, to - 1, { steps: before.steps + shift }), to, { steps: after.steps - shift });
}

/** The blocks with one of them moved. */
export function moveBlock(blocks: readonly WalkBlock[], from: number, to: number): WalkBlock[] {
  const rest = blocks.filter((_, i) => i !== from);
  rest.splice(to, 0, blocks[from]!);
  return rest;
}

/** The blocks with a new one after another one. */
export function addBlock(blocks: readonly WalkBlock[], after: number, styles: Selection): WalkBlock[] {
  const added: WalkBlock = { ...NEW_BLOCK, styles };
  return [...blocks.slice(0, after + 1), added, ...blocks.slice(after + 1)];
}

/** The blocks without one of them; the last one cannot be removed. */
export function removeBlock(blocks: readonly WalkBlock[], index: number): WalkBlock[] {
  return blocks.length < 2 ? [...blocks] : blocks.filter((_, i) => i !== index);
}

/** The initial plan: the neutral style and two others. */
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
 * The blocks with only the styles of the model; `undefined` if the model has all of them. A block without remaining
 * styles becomes neutral, or is removed if there is no neutral style.
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

/** The style with the largest weight in a block. */
export function mainStyle({ styles }: WalkBlock): string {
  return styles.reduce((a, b) => (Math.abs(b.weight) > Math.abs(a.weight) ? b : a)).name;
}
