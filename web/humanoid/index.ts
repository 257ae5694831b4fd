/** The canonical humanoid: the layout of poses, forward kinematics, placement. */
export * from "./forward_kinematics";
export * from "./layout";
export * from "./placement";
export * from "./rotations";
