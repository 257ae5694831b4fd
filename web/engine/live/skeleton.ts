/** Meaning of the numbers in a live stream's frames. */

export type StreamSkeleton =
  /** Poses on the body of the database: 87 numbers. */
  | { readonly kind: "humanoid" }
  /** The position of joint 0, then the local rotation xyzw of every joint. */
  | ({ readonly kind: "joints" } & StreamJoints)
  /** The channels of a BVH file; `header` is the part of the file before its frames. */
  | { readonly kind: "bvh"; readonly header: string }
  /**
   * Landmarks in a camera image: 33 × (x, y, z, visibility), metres about the middle of the hips, y down, z from the
   * camera.
   */
  | { readonly kind: "landmarks"; readonly mirrored: boolean };

/** Joints in the pose in which all rotations are the identity. Parents come before their children. */
export interface StreamJoints {
  /** Names of the joints. */
  readonly names: readonly string[];
  /** Index of each joint's parent; −1 for joint 0. */
  readonly parents: readonly number[];
  /** Offset from the parent: x, y and z of every joint. */
  readonly offsets: ArrayLike<number>;
  /** Metres per unit of length; estimated from the size of the body if missing. */
  readonly unit?: number | undefined;
}
