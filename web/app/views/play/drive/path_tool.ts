/** Lines drawn on the ground: a stroke is a path to follow, a click is a target to walk to. */

/** A position on the ground, metres. */
export interface Spot {
  readonly x: number;
  readonly z: number;
}

/** Distance between points of a path, metres. */
const SPACING = 0.1;
/**
 * Radius of smoothing, metres: every point becomes the mean of its neighbourhood, since a hand trembles and a character
 * cannot turn in a point.
 */
const NEARBY = 0.3;
/** If a stroke begins farther from the character than this, the character walks to its start first, metres. */
const NEAR = 0.3;
/** Points beyond this distance are near the horizon, where a pixel covers metres. */
const FAR = 40;
/** Longest movement of a click, pixels. */
const CLICK_PX = 4;

/** Points of a path, x and z each, from the character's position along a stroke. Pure. */
export function pathOf(from: Spot, stroke: readonly Spot[]): Float32Array<ArrayBuffer> {
  const [first] = stroke;
  if (!first) return new Float32Array();
  const leads = Math.hypot(first.x - from.x, first.z - from.z) > NEAR || stroke.length === 1;
  const line = smoothed(evenly(leads ? [from, ...stroke] : stroke));
  return Float32Array.from(line.flatMap(({ x, z }) => [x, z]));
}

/** Resamples the line at a constant spacing. */
function evenly(stroke: readonly Spot[]): Spot[] {
  const line = [stroke[0]!];
  let left = SPACING;
  for (let i = 1; i < stroke.length; i++) {
    let from = stroke[i - 1]!;
    const to = stroke[i]!;
    let length = Math.hypot(to.x - from.x, to.z - from.z);
    while (length >= left) {
      const share = left / length;
      from = { x: from.x + (to.x - from.x) * share, z: from.z + (to.z - from.z) * share };
      line.push(from);
      length -= left;
      left = SPACING;
    }
    left -= length;
  }
  const last = stroke.at(-1)!;
  if (line.at(-1) !== last) line.push(last);
  return line;
}

/** Smooths the line; its ends are unchanged. */
function smoothed(line: readonly Spot[]): Spot[] {
  const half = Math.round(NEARBY / SPACING);
  return line.map((_, i) => {
    const reach = Math.min(half, i, line.length - 1 - i);
    const near = line.slice(i - reach, i + reach + 1);
    const mean = (of: (spot: Spot) => number) => near.reduce((sum, spot) => sum + of(spot), 0) / near.length;
    return { x: mean(({ x }) => x), z: mean(({ z }) => z) };
  });
}

/** Distance of a position from a path, metres. Pure. */
export function distanceTo(path: Float32Array, { x, z }: Spot): number {
  let least = Number.POSITIVE_INFINITY;
  for (let i = 2; i < path.length; i += 2) {
    const [ax, az] = [path[i - 2]!, path[i - 1]!];
    const [bx, bz] = [path[i]! - ax, path[i + 1]! - az];
    const along = ((x - ax) * bx + (z - az) * bz) / (bx * bx + bz * bz || 1);
    const t = Math.min(1, Math.max(0, along));
    least = Math.min(least, Math.hypot(x - ax - t * bx, z - az - t * bz));
  }
  return least;
}

/** The page's interface for the tool. */
interface PathGround {
  /** The point on the ground under a point of the page. */
  groundAt(clientX: number, clientY: number): Spot | undefined;
  /** Whether the character's body is there: a click on it selects a body part. */
  isBody(clientX: number, clientY: number): boolean;
  /** Position of the character. */
  place(): Spot;
  /** Shows the line while it is drawn. */
  sketch(points: Float32Array<ArrayBuffer>): void;
  /** Called with a path to follow. */
  onPath(points: Float32Array<ArrayBuffer>): void;
}

export class PathTool {
  /** Whether a stroke draws a path; otherwise it turns the camera, and only a click sets a target. */
  draws = false;
  #pointer: number | undefined;
  #stroke: Spot[] = [];
  #pressed: { x: number; y: number } | undefined;

  constructor(picture: HTMLElement, ground: PathGround, signal: AbortSignal) {
    const options = { signal, capture: true };
    const spotAt = ({ clientX, clientY }: MouseEvent): Spot | undefined => {
      const spot = ground.groundAt(clientX, clientY);
      const { x, z } = ground.place();
      return spot && Math.hypot(spot.x - x, spot.z - z) < FAR ? spot : undefined;
    };
    picture.addEventListener(
      "pointerdown",
      (event) => {
        if (event.button !== 0 || this.#pointer !== undefined) return;
        this.#pressed = { x: event.clientX, y: event.clientY };
        const spot = this.draws && spotAt(event);
        if (!spot) return;
        event.stopPropagation();
        picture.setPointerCapture(event.pointerId);
        this.#pointer = event.pointerId;
        this.#stroke = [spot];
      },
      options,
    );
    picture.addEventListener(
      "pointermove",
      (event) => {
        if (event.pointerId !== this.#pointer) return;
        event.stopPropagation();
        const spot = spotAt(event);
        if (spot) this.#stroke.push(spot);
        ground.sketch(pathOf(this.#stroke[0]!, this.#stroke));
      },
      options,
    );
    const onEnd = (event: PointerEvent): void => {
      if (event.pointerId !== this.#pointer) return;
      this.#pointer = undefined;
      if (this.#stroke.length > 1) ground.onPath(pathOf(ground.place(), this.#stroke));
    };
    for (const type of ["pointerup", "pointercancel"] as const) picture.addEventListener(type, onEnd, options);
    const onClick = (event: MouseEvent): void => {
      const moved = this.#pressed ? Math.hypot(event.clientX - this.#pressed.x, event.clientY - this.#pressed.y) : 0;
      const isClick = moved <= CLICK_PX && this.#stroke.length < 2 && !ground.isBody(event.clientX, event.clientY);
      this.#stroke = [];
      const spot = isClick ? spotAt(event) : undefined;
      if (spot) ground.onPath(pathOf(ground.place(), [spot]));
    };
    picture.addEventListener("click", onClick, { signal });
  }

  /** Whether a stroke is being drawn. */
  get isDrawing(): boolean {
    return this.#pointer !== undefined;
  }
}
