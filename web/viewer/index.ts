/** What the viewer exports. */

export { graphics } from "./stage/graphics";
export type { CameraView } from "./stage/orbit_camera";
export { Screen } from "./stage/screen";
export type { ThemeColours, ThemeName } from "./themes";
export { type GhostMode, type MotionTrailMode, VIEWER_DEFAULTS, Viewer, type ViewerOptions } from "./viewer";
