/** The viewer's public face. */

export { DEFAULT_PROPORTIONS, JOINT, JOINTS, POSE_FLOATS, ROLES, type Role, restPose } from "./humanoid";
export type { CameraView } from "./stage/orbit_camera";
export type { ThemeName } from "./themes";
export { type GhostMode, VIEWER_DEFAULTS, Viewer, type ViewerOptions } from "./viewer";
