/** Exports of the viewer. */

export type { MotionTrailMode } from "./clip_trail";
export type { GhostMode } from "./ghost";
export type { GhostBody } from "./ghost_bodies";
export type { Performer } from "./performer";
export { preparation } from "./prepare";
export { graphics, setGraphics } from "./stage/graphics";
export type { CameraView, Zooming } from "./stage/orbit_camera";
export { Screen } from "./stage/screen";
export type { ThemeColours, ThemeName } from "./themes";
export { type Prop, VIEWER_DEFAULTS, Viewer, type ViewerOptions } from "./viewer";
