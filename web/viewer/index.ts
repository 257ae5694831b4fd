/** The viewer's public face. */

export {
  createWorldPose,
  DEFAULT_PROPORTIONS,
  headingOf,
  JOINT,
  JOINTS,
  POSE_FLOATS,
  ROLES,
  type Role,
  restPose,
  type WorldPose,
  worldFromLocal,
} from "./humanoid";
export { graphics } from "./stage/graphics";
export type { CameraView } from "./stage/orbit_camera";
export type { ThemeName } from "./themes";
export { type GhostMode, type TraceMode, VIEWER_DEFAULTS, Viewer, type ViewerOptions } from "./viewer";
