/** What a device asks for, in the frame of the picture, and what that is over the ground. Pure. */

/** Where to, how fast, and whether only to turn there. */
export interface Wish {
  /** Right in the picture and away from the viewer, of length 0 to 1. */
  readonly right: number;
  readonly ahead: number;
  /** 1 walks, 2 runs. */
  readonly gait: number;
  /** Whether the character turns that way on the spot. */
  readonly turns?: boolean;
}

/** A deflection that a stick at rest may have, and up to which one turns without going. */
const DEAD = 0.2;
const TURNING = 0.35;

/** What a stick asks for that is deflected to the right and away by shares of its reach; `undefined` in its dead zone. */
export function stickWish(right: number, ahead: number, gait: number): Wish | undefined {
  const deflection = Math.hypot(right, ahead);
  if (!(deflection > DEAD)) return undefined;
  const turns = deflection < TURNING;
  // The square lets small deflections be told apart.
  const length = turns ? 1 : ((Math.min(deflection, 1) - DEAD) / (1 - DEAD)) ** 2;
  return { right: (right / deflection) * length, ahead: (ahead / deflection) * length, gait, turns };
}

/** A wish over the ground, [x, z]; `sight` is where the camera looks. */
export function overGround(
  { right, ahead }: Wish,
  sight: readonly [x: number, y: number, z: number],
): [number, number] {
  const [sx, , sz] = sight;
  const length = Math.hypot(sx, sz) || 1;
  const [x, z] = [sx / length, sz / length];
  return [ahead * x - right * z, ahead * z + right * x];
}

/** The heading of a way over the ground, radians about +Y from +Z to +X. */
export const headingOf = (x: number, z: number): number => Math.atan2(x, z);
