/** Steering input of a device in the picture's frame, and its conversion to the ground. Pure functions. */

/** Direction, speed, and whether only to turn. */
export interface Wish {
  /** Right in the picture and away from the viewer, length 0 to 1. */
  readonly right: number;
  readonly ahead: number;
  /** 1 walk, 2 run. */
  readonly gait: number;
  /** Whether the character turns to this direction on the spot. */
  readonly turns?: boolean;
}

/** Dead zone of a stick at rest, and the deflection up to which it only turns the character. */
const DEAD = 0.2;
const TURNING = 0.35;

/** The input of a stick deflected to the right and away by shares of its range; `undefined` in its dead zone. */
export function stickWish(right: number, ahead: number, gait: number): Wish | undefined {
  const deflection = Math.hypot(right, ahead);
  if (!(deflection > DEAD)) return undefined;
  const turns = deflection < TURNING;
  // The square makes small deflections finer.
  const length = turns ? 1 : ((Math.min(deflection, 1) - DEAD) / (1 - DEAD)) ** 2;
  return { right: (right / deflection) * length, ahead: (ahead / deflection) * length, gait, turns };
}

/** An input converted to the ground, [x, z]; `sight` is the camera's viewing direction. */
export function overGround(
  { right, ahead }: Wish,
  sight: readonly [x: number, y: number, z: number],
): [number, number] {
  const [sx, , sz] = sight;
  const length = Math.hypot(sx, sz) || 1;
  const [x, z] = [sx / length, sz / length];
  return [ahead * x - right * z, ahead * z + right * x];
}

/** The heading of a direction on the ground, radians about +Y from +Z to +X. */
export const headingOf = (x: number, z: number): number => Math.atan2(x, z);
