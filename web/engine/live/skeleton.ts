/** What the numbers of a live stream's frames are. */

export type StreamSkeleton =
  /** Poses on the body of the database: 87 numbers. */
  | { readonly kind: "humanoid" }
  /** The place of joint 0, then the local rotation xyzw of every joint. */
  | ({ readonly kind: "joints" } & StreamJoints)
  /** The channels of a BVH file, of which this is what stands before its frames. */
  | { readonly kind: "bvh"; readonly header: string }
  /** Landmarks of a camera's picture: 33 × (x, y, z, visibility), metres about the middle of the hips, y down, z from the camera. */
  | { readonly kind: "landmarks"; readonly mirrored: boolean };

/** Joints, each behind its parent, in the pose in which all rotations are the identity. */
export interface StreamJoints {
  /** Names of the joints. */
  readonly names: readonly string[];
  /** Index of each joint's parent; −1 for joint 0. */
  readonly parents: readonly number[];
  /** From the parent: x, y and z of every joint. */
  readonly offsets: ArrayLike<number>;
  /** Metres of a unit of length; told by the size of the body where it is missing. */
  readonly unit?: number | undefined;
}
