/** What the element exports. */
export { ATTRIBUTES, type AttributeName, type Control } from "./attributes";
export { hostPlayers, type PlayerHost } from "./host";
export { type FrameDetail, StrutPlayer } from "./player_element";
