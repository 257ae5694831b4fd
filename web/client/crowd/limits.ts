/** What a crowd can be. */
export { type FieldVertex, MAX_CROWD, MAX_ROUTE_POINTS, MAX_VERTICES, type Place } from "../../engine/crowd/limits";
