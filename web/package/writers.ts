/** The writers of files and clips, loaded with the first motion that is styled. */
export { MissingJointError, toAnimationClip } from "../formats/animation_clip";
export { mannequinGlb } from "../formats/mannequin_glb";
export { vrmAnimation } from "../formats/vrma";
