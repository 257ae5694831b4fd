/**
 * Placement of the labels of the style polygon: pure geometry. Every label has a few positions, the best first; the
 * combination with the least overlap inside the drawing is chosen.
 */
import { direction, type Point } from "./geometry";

/** The vertex that a label belongs to. */
export interface LabelledVertex {
  name: string;
  /** Weight, if the style is selected. */
  weight: number | undefined;
  position: Point;
}

/** Position of a label: that of its name, and the distance of its number below it, 0 for the same line. */
export interface LabelPlace extends Point {
  anchor: "start" | "middle" | "end";
  numberBelow: number;
}

/** Space for labels around the centre of the polygon, pixels. */
export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** The radial bar of a vertex's weight: its length, its width and its distance from the vertex, pixels. */
export const BAR = { length: 22, width: 6, gap: 9 };
/** Distance from a vertex to the label of an idle style. */
const IDLE_GAP = 12;
/** Distance from a bar's outer end to a label next to it. */
const BESIDE_GAP = 8;
/** Distance of two lines, half the height of one, and the distance of a name and a number on one line. */
const LINE = 15;
const HALF_LINE = 7;
export const WORD_GAP = 6;
/** Mean width of a letter of a name, and width of a number: approximate sizes of the drawn text. */
const LETTER = 6.9;
const NUMBER = 28;
/** Penalty of a position over the one before it, in square pixels of overlap: idle labels hardly move. */
const RANK = { selected: 4, idle: 100 };
/** Factor of covering a label relative to reaching into the padding of the panel. */
const COVERED = 4;
/** Number of labels placed jointly: those of a triangle. Further ones are placed one after another. */
const TOGETHER = 3;

/** Direction of a vertex's label: left of it, right of it, or centred if the vertex is at the top or the bottom. */
const sideOf = (out: Point): -1 | 0 | 1 => (Math.abs(out.x) < 0.3 ? 0 : out.x > 0 ? 1 : -1);
const ANCHORS = { "-1": "end", "0": "middle", "1": "start" } as const;

function idlePlaces(position: Point): LabelPlace[] {
  const out = direction(position);
  const side = sideOf(out);
  const gap = side === 0 ? IDLE_GAP + HALF_LINE : IDLE_GAP;
  const at = (distance: number) => ({ x: position.x + out.x * distance, y: position.y + out.y * distance });
  const inwards = ANCHORS[`${-side as -1 | 0 | 1}`];
  return [
    { ...at(gap), anchor: ANCHORS[`${side}`], numberBelow: 0 },
    { ...at(-gap), anchor: inwards, numberBelow: 0 },
  ];
}

/** The position of a name alone, centred above its vertex or below it. */
export function placeBeyond(position: Point): LabelPlace {
  const side = position.y > 0 ? 1 : -1;
  return { x: position.x, y: position.y + side * (IDLE_GAP + HALF_LINE), anchor: "middle", numberBelow: 0 };
}

function selectedPlaces(position: Point, room: Box): LabelPlace[] {
  const out = direction(position);
  const side = sideOf(out);
  const reach = BAR.gap + BAR.length;
  const tip = { x: position.x + out.x * reach, y: position.y + out.y * reach };
  if (side === 0) {
    const y = tip.y - Math.sign(out.y) * HALF_LINE;
    const beside: LabelPlace[] = [
      { x: tip.x + BESIDE_GAP, y, anchor: "start", numberBelow: 0 },
      { x: tip.x - BESIDE_GAP, y, anchor: "end", numberBelow: 0 },
    ];
    if (out.x < 0) beside.reverse();
    const over = { x: position.x, y: tip.y - HALF_LINE - WORD_GAP, anchor: "middle", numberBelow: 0 } as const;
    return out.y < 0 ? [over, ...beside] : beside;
  }
  if (Math.abs(out.x) > 0.85) {
    const place = { x: side > 0 ? room.right : room.left, anchor: ANCHORS[`${-side as -1 | 1}`] };
    return [
      { ...place, y: position.y - LINE + 1, numberBelow: 2 * LINE - 1 },
      { ...place, y: position.y - LINE + 1, numberBelow: 0 },
      { ...place, y: position.y + LINE, numberBelow: 0 },
    ];
  }
  const place = { x: position.x + side * (reach - 4), anchor: ANCHORS[`${side}`] };
  const outwards = out.y < 0 ? tip.y - LINE : tip.y;
  const inwards = out.y < 0 ? tip.y : tip.y - LINE;
  const line = tip.y - (out.y > 0 ? HALF_LINE : 0);
  return [
    { ...place, y: outwards, numberBelow: LINE },
    { ...place, y: inwards, numberBelow: LINE },
    { ...place, y: line, numberBelow: 0 },
    { ...place, y: line - Math.sign(out.y) * LINE, numberBelow: 0 },
  ];
}

/** The box of a label at a position, estimated without drawing it. */
export function boxOf({ name, weight }: LabelledVertex, place: LabelPlace): Box {
  const word = name.length * LETTER;
  const beside = weight === undefined ? 0 : WORD_GAP + NUMBER;
  const width = place.numberBelow > 0 ? Math.max(word, NUMBER) : word + beside;
  const left = place.x - { start: 0, middle: width / 2, end: width }[place.anchor];
  const [top, bottom] = [place.y - HALF_LINE, place.y + place.numberBelow + HALF_LINE];
  return { left, right: left + width, top, bottom };
}

function barBox(position: Point): Box {
  const out = direction(position);
  const [from, to] = [BAR.gap, BAR.gap + BAR.length];
  const xs = [position.x + out.x * from, position.x + out.x * to];
  const ys = [position.y + out.y * from, position.y + out.y * to];
  const half = BAR.width / 2;
  return {
    left: Math.min(...xs) - half,
    right: Math.max(...xs) + half,
    top: Math.min(...ys) - half,
    bottom: Math.max(...ys) + half,
  };
}

/** Overlap of two boxes, square pixels. */
export function overlap(a: Box, b: Box): number {
  const width = Math.min(a.right, b.right) - Math.max(a.left, b.left);
  const height = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
  return Math.max(0, width) * Math.max(0, height);
}

/** Area of a box, square pixels. */
export const area = ({ left, right, top, bottom }: Box): number => (right - left) * (bottom - top);

/** A possible position of a label, its box, and its own cost. */
interface Choice {
  place: LabelPlace;
  box: Box;
  cost: number;
}

const covered = (box: Box, by: readonly Box[]): number =>
  COVERED * by.reduce((sum, other) => sum + overlap(box, other), 0);

const boxesOf = (choices: readonly Choice[]): Box[] => choices.map(({ box }) => box);

/** The position of each label for which the total cost is smallest. */
function together(labels: readonly Choice[][]): Choice[] {
  const cost = (chosen: readonly Choice[]) =>
    chosen.reduce((sum, one, i) => sum + one.cost + covered(one.box, boxesOf(chosen.slice(0, i))), 0);
  const all = labels.reduce<Choice[][]>(
    (some, next) => some.flatMap((chosen) => next.map((one) => [...chosen, one])),
    [[]],
  );
  return all.reduce((a, b) => (cost(b) < cost(a) ? b : a));
}

/**
 * Idle labels that would cover others at these positions: they are shown only while the vertex is hovered or focused.
 * Those of selected styles are always shown, and of idle ones as many as there is room for.
 */
export function coveringLabels(vertices: readonly LabelledVertex[], places: readonly LabelPlace[]): boolean[] {
  const boxes = vertices.map((vertex, i) => boxOf(vertex, places[i]!));
  const shown = boxes.filter((_, i) => vertices[i]!.weight !== undefined);
  return vertices.map(({ weight }, i) => {
    const box = boxes[i]!;
    const covers = weight === undefined && shown.some((other) => overlap(box, other) > 0);
    if (weight === undefined && !covers) shown.push(box);
    return covers;
  });
}

/** Positions of the labels of vertices, in order. Those of idle styles make room for those of selected ones. */
export function placeLabels(vertices: readonly LabelledVertex[], room: Box): LabelPlace[] {
  const bars = vertices.map(({ weight, position }) => (weight === undefined ? [] : [barBox(position)]));
  const choices = vertices.map((vertex, i) => {
    const isIdle = vertex.weight === undefined;
    const places = isIdle ? idlePlaces(vertex.position) : selectedPlaces(vertex.position, room);
    const worse = isIdle ? RANK.idle : RANK.selected;
    const others = bars.filter((_, j) => j !== i).flat();
    return places.map((place, rank): Choice => {
      const box = boxOf(vertex, place);
      return { place, box, cost: worse * rank + area(box) - overlap(box, room) + covered(box, others) };
    });
  });
  const selected = choices.filter((_, i) => vertices[i]!.weight !== undefined);
  const chosen = together(selected.slice(0, TOGETHER));
  const free = (places: readonly Choice[]) => {
    const boxes = boxesOf(chosen);
    const costs = places.map(({ box, cost }) => cost + covered(box, boxes));
    return places[costs.indexOf(Math.min(...costs))]!;
  };
  for (const places of selected.slice(TOGETHER)) chosen.push(free(places));
  return choices.map((places) => (chosen[selected.indexOf(places)] ?? free(places)).place);
}
