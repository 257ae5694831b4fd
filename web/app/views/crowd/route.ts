/** Converts a route drawn by hand to the route of a crowd. */
import { MAX_ROUTE_POINTS, type Place } from "../../../client/crowd/limits";

/** Distance between points of a route, metres: the hand is not more precise. */
const STEP = 0.5;
/** If the ends are nearer than this, the route is closed, metres. */
const MEETS = 1.2;

/** The points of a drawn line, at least one step apart, at most as many as a route has; empty if it is too short. */
export function routeOf(drawn: readonly Place[]): Place[] {
  const points: Place[] = [];
  for (const point of drawn) {
    const last = points.at(-1);
    if (!last || distance(last, point) >= STEP) points.push(point);
  }
  if (points.length < 2) return [];
  const thinned = thin(points);
  const [first, last] = [thinned[0]!, thinned.at(-1)!];
  return thinned.length > 3 && distance(first, last) < MEETS ? [...thinned.slice(0, -1), first] : thinned;
}

function thin(points: readonly Place[]): Place[] {
  const count = Math.min(points.length, MAX_ROUTE_POINTS);
  return Array.from({ length: count }, (_, i) => {
    const [x, z] = points[Math.round((i * (points.length - 1)) / (count - 1))]!;
    return [Math.round(100 * x) / 100, Math.round(100 * z) / 100];
  });
}

/** The points of a route with intermediate points, so that a line through their positions in the picture lies on the ground. */
export function dense(route: readonly Place[]): Place[] {
  return route.flatMap((to, i) => {
    const from = route[i - 1];
    if (!from) return [to];
    const parts = Math.max(1, Math.ceil(distance(from, to) / STEP));
    return Array.from({ length: parts }, (_, n): Place => {
      const share = (n + 1) / parts;
      return [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
    });
  });
}

const distance = (a: Place, b: Place): number => Math.hypot(a[0] - b[0], a[1] - b[1]);
