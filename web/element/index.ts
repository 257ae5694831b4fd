/** Exports of the element. */
export { ATTRIBUTES, type AttributeName, type Control } from "./attributes";
export type { FrameDetail, StrutPlayerEventMap } from "./events";
export { hostPlayers, type PlayerHost } from "./host";
export { StrutPlayer } from "./player_element";
