/** Limits of a crowd's parameters. */
export {
  type FieldVertex,
  MAX_CROWD,
  MAX_ROUTE_POINTS,
  MAX_VERTICES,
  type People,
  type Place,
  type Recorded,
} from "../../engine/crowd/limits";
