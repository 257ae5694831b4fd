/** Types of the character module (`shared/spec/embedding.md` section 3). */
import type { AnimationClip, Object3D } from "three";
import type { Role } from "../humanoid";
import type { Licence } from "./licence";
import type { GltfJson } from "./vrm_humanoid";

/** A loaded VRM of three-vrm, by structure. */
export interface VrmLike {
  /** The object to add to the scene. */
  readonly scene: Object3D;
  /** The bones by their VRM names. */
  readonly humanoid: {
    autoUpdateHumanBones: boolean;
    getRawBoneNode(bone: string): Object3D | null;
    getNormalizedBoneNode(bone: string): Object3D | null;
  };
  /** Terms of use in the file. */
  readonly meta?: unknown;
  /** The spring bones. */
  readonly springBoneManager?: { reset(): void } | null;
  /** Advances the spring bones. */
  update(dtSecs: number): void;
}

/** The result of three.js's `GLTFLoader`, by structure. */
export interface GltfLike {
  /** The object to add to the scene. */
  readonly scene: Object3D;
  /** The animations in the file. */
  readonly animations?: readonly AnimationClip[];
  /** Where three-vrm stores the VRM. */
  readonly userData?: Record<string, unknown>;
  /** The file's JSON, and the mapping from objects to nodes. */
  readonly parser: {
    readonly json: unknown;
    readonly associations: ReadonlyMap<unknown, { nodes?: number | undefined } | undefined>;
  };
}

/** Options of `bindCharacter`. */
export interface BindOptions {
  /** Name of the joint of each known role, as in the file or as in three.js; the others are found automatically. */
  roles?: Partial<Record<Role, string>>;
  /** Metres per unit inside the character's object; 1 by default, as in glTF. */
  metresPerUnit?: number;
  /** Height of the soles in the bind pose, in the units of the character's object; by default measured on the mesh. */
  soleHeight?: number;
}

/** A styled motion, like the package's `StyledMotion`. */
export interface StyledPoses {
  /** Name of the motion. */
  readonly name: string;
  /** The body on which the poses are defined: 21 × xyz, metres. */
  readonly proportions: ArrayLike<number>;
  /** 87 numbers a frame. */
  readonly poses: Float32Array;
  /** Output time of each frame, seconds. */
  readonly timeOut: Float32Array;
}

/** Options of a clip. */
export interface CharacterClipOptions {
  /** Name of the clip; by default the motion's. */
  name?: string;
  /** Whether the body stays at its start (in place), for game engines with root motion of their own. */
  inPlace?: boolean;
  /**
   * The clip that was styled. Its tracks that do not move the body are kept, retimed to the styled motion: fingers,
   * faces, morphs.
   */
  keep?: AnimationClip;
}

/** A motion in a file. It is read from the file's bones on demand. */
export interface CharacterMotion {
  /** Its name in the file. */
  readonly name: string;
  /** Number of frames. */
  readonly frames: number;
  /** Frames per second. */
  readonly rateHz: number;
  /** Length, seconds. */
  readonly durationSecs: number;
  /** The body for which it was made, metres: 21 × xyz. */
  readonly proportions: Float32Array;
  /**
   * 87 numbers per frame.
   * @param body the body on which the poses are defined, 21 × xyz; by default that of `Character.setBody`, and without
   * a character the motion's own
   * @throws StrutError `bad-input` if this is not a body, `bad-file` if the bones are out of range
   */
  poses(body?: ArrayLike<number>): Float32Array;
  /** The text of a BVH file of the motion on its own body, for `Strut.openMotion`. @throws StrutError `bad-file` */
  toBVH(): string;
}

/** A rigged character that performs poses. */
export interface Character {
  /** The object to add to the scene; the caller places it. */
  readonly object: Object3D;
  /** Names of all joints, as in the file; parents come before their children. */
  readonly joints: readonly string[];
  /** Name of the joint of each role, as in the file. */
  readonly roles: Readonly<Partial<Record<Role, string>>>;
  /** Confidence in the roles, 0–1; below 0.7 the user should check them. */
  readonly confidence: number;
  /** Sentences for the user on what was matched and assumed. */
  readonly notes: readonly string[];
  /** The notes about things that are missing or were changed: textures, materials, soles, size. */
  readonly warnings: readonly string[];
  /** Permissions by the model's author; `undefined` if the file has none. */
  readonly licence: Licence | undefined;
  /** The motions in the character's file, which can be styled like any poses. */
  readonly motions: readonly CharacterMotion[];
  /** The character's own body as canonical humanoid, metres: 21 × xyz. */
  readonly proportions: Float32Array;
  /**
   * Sets the body on which the poses of {@link apply} are defined: `Database.info.proportions`. By default the
   * mannequin's.
   * @throws StrutError `bad-input` unless these are 63 numbers of a body
   */
  setBody(proportions: ArrayLike<number>): void;
  /**
   * Applies a pose of 87 numbers: the bones of roles are rotated and the hips are moved; fingers and faces do not
   * change. It allocates nothing.
   * @throws StrutError `bad-input` unless the numbers are finite, `disposed`
   */
  apply(pose: ArrayLike<number>): void;
  /**
   * The current pose, 87 numbers on the character's own body ({@link proportions}): the actual positions of its joints.
   * Callers must not keep the array.
   */
  readonly pose: Readonly<Float32Array>;
  /** Advances the spring bones, hair and clothes of a VRM, by at most 1/30 s. */
  update(dtSecs: number): void;
  /** Brings the spring bones to rest, as after a cut. */
  settle(): void;
  /** The motion as a clip of three.js for {@link object}, one key per frame. */
  toClip(motion: StyledPoses, options?: CharacterClipOptions): AnimationClip;
  /**
   * The character's own file with the motion as an additional animation; an FBX character as glTF.
   * @throws StrutError `licence` if the author forbids it, `bad-input` if the character has no file
   */
  toGLB(motion: StyledPoses): Uint8Array<ArrayBuffer>;
  /** Frees it; the caller removes it from the scene. */
  dispose(): void;
}

/** The source of a bound character. */
export interface Origin {
  readonly object: Object3D;
  readonly json: GltfJson | undefined;
  readonly vrm: VrmLike | undefined;
  /** The motions in the file. */
  readonly clips: readonly AnimationClip[];
  /** Sentences for the user on parts of the file that cannot be displayed. */
  readonly notes?: readonly string[];
  /** The three.js node of an index in the file. */
  readonly nodeOf: (index: number) => Object3D | undefined;
  /** The index in the file of a three.js node. */
  readonly indexOf: (node: Object3D) => number | undefined;
}
