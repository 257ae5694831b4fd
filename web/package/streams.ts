/** `strut-motion/streams`: sources of live poses for `Strut.live`. */
export type { LiveStats, StreamFrame } from "../client/live/protocol";
export { StrutError, type StrutErrorCode } from "../engine/errors";
export type { BufferStats, Play } from "../engine/live/pose_stream";
export type { StreamJoints, StreamSkeleton } from "../engine/live/skeleton";
export {
  type Landmark,
  type LandmarkOptions,
  landmarkPoses,
  type OnLandmarks,
} from "../streams/landmark_poses";
export type { Live, LiveOptions, LiveRecorder, LiveRecording } from "../streams/live";
export type { PoseSink, PoseSource } from "../streams/pose_source";
export {
  type SocketState,
  STREAM_FORMATS,
  type StreamFormat,
  type WebSocketOptions,
  webSocketPoses,
} from "../streams/web_socket_poses";
