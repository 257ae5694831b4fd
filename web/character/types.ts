/** What goes in and out of the room of characters (`shared/spec/embedding.md` section 3). */
import type { AnimationClip, Object3D } from "three";
import type { Role } from "../humanoid";
import type { Licence } from "./licence";
import type { GltfJson } from "./vrm_humanoid";

/** A loaded VRM of three-vrm, by structure. */
export interface VrmLike {
  /** The object that is put into the scene. */
  readonly scene: Object3D;
  /** The bones by their VRM names. */
  readonly humanoid: {
    autoUpdateHumanBones: boolean;
    getRawBoneNode(bone: string): Object3D | null;
    getNormalizedBoneNode(bone: string): Object3D | null;
  };
  /** What the file says on its use. */
  readonly meta?: unknown;
  /** What swings by itself. */
  readonly springBoneManager?: { reset(): void } | null;
  /** Moves what swings. */
  update(dtSecs: number): void;
}

/** What three.js's `GLTFLoader` gives, by structure. */
export interface GltfLike {
  /** The object that is put into the scene. */
  readonly scene: Object3D;
  /** The animations in the file. */
  readonly animations?: readonly AnimationClip[];
  /** Where three-vrm leaves the VRM. */
  readonly userData?: Record<string, unknown>;
  /** The file's JSON, and which object came of which node. */
  readonly parser: {
    readonly json: unknown;
    readonly associations: ReadonlyMap<unknown, { nodes?: number | undefined } | undefined>;
  };
}

/** Options of `bindCharacter`. */
export interface BindOptions {
  /** Name of the joint of each role that is known, as in the file or as in three.js; the others are found. */
  roles?: Partial<Record<Role, string>>;
  /** Metres a unit inside the character's object; 1 unless given, as glTF says. */
  metresPerUnit?: number;
  /** Height of the soles in the bind pose, in the units of the character's object; measured on the mesh unless given. */
  soleHeight?: number;
}

/** A motion in a style, as the package's `StyledMotion` has it. */
export interface StyledPoses {
  /** Name of the motion. */
  readonly name: string;
  /** The body that the poses are on: 21 × xyz, metres. */
  readonly proportions: ArrayLike<number>;
  /** 87 numbers a frame. */
  readonly poses: Float32Array;
  /** Seconds of each frame. */
  readonly timeOut: Float32Array;
}

/** Options of a clip. */
export interface CharacterClipOptions {
  /** Name of the clip; the motion's unless given. */
  name?: string;
  /** Whether the body stays over its start, as game engines with root motion of their own expect. */
  inPlace?: boolean;
  /** The clip that was styled: what it moves besides the body is kept, in the styled motion's time: fingers, faces, morphs. */
  keep?: AnimationClip;
}

/** A motion in a file. It is read of the file's bones when it is asked for. */
export interface CharacterMotion {
  /** Its name in the file. */
  readonly name: string;
  /** Its frames. */
  readonly frames: number;
  /** Frames a second. */
  readonly rateHz: number;
  /** Length, seconds. */
  readonly durationSecs: number;
  /** The body that it was made for, metres: 21 × xyz. */
  readonly proportions: Float32Array;
  /**
   * 87 numbers a frame.
   * @param body the body that they are on, 21 × xyz; that of `Character.setBody` unless given, and where there is no character
   *   the motion's own
   * @throws StrutError `bad-input` if this is no body, `bad-file` if the bones go beyond all numbers
   */
  poses(body?: ArrayLike<number>): Float32Array;
  /** The text of a BVH file of the motion on its own body, which `Strut.openMotion` opens. @throws StrutError `bad-file` */
  toBVH(): string;
}

/** A rigged character that performs poses. */
export interface Character {
  /** What is put into the scene; its placement is the caller's. */
  readonly object: Object3D;
  /** Names of all joints, as in the file; parents come before their children. */
  readonly joints: readonly string[];
  /** Name of the joint of each role, as in the file. */
  readonly roles: Readonly<Partial<Record<Role, string>>>;
  /** Confidence in the roles, 0–1; below 0.7 a person should look at them. */
  readonly confidence: number;
  /** Sentences for people on what was matched and assumed. */
  readonly notes: readonly string[];
  /** Those of the notes that say what is missing or was changed: textures, materials, soles, size. */
  readonly warnings: readonly string[];
  /** What the model's author allows; `undefined` where the file does not say. */
  readonly licence: Licence | undefined;
  /** The motions in the character's file; they can be styled as any poses can. */
  readonly motions: readonly CharacterMotion[];
  /** The character's own body as canonical humanoid, metres: 21 × xyz. */
  readonly proportions: Float32Array;
  /**
   * Says which body the poses of {@link apply} are on: `Database.info.proportions`. The mannequin's until then.
   * @throws StrutError `bad-input` unless these are 63 numbers of a body
   */
  setBody(proportions: ArrayLike<number>): void;
  /**
   * Takes a pose of 87 numbers: the bones of roles are turned and the hips are moved; fingers and faces stay. It allocates
   * nothing.
   * @throws StrutError `bad-input` unless the numbers are finite, `disposed`
   */
  apply(pose: ArrayLike<number>): void;
  /** The pose that it holds, 87 numbers on its own body ({@link proportions}): where its joints really are. Not to be kept. */
  readonly pose: Readonly<Float32Array>;
  /** Moves what swings by itself, hair and clothes of a VRM; at most 1/30 s at once. */
  update(dtSecs: number): void;
  /** Brings what swings to rest, as after a cut. */
  settle(): void;
  /** The motion as a clip of three.js for {@link object}, a key a frame. */
  toClip(motion: StyledPoses, options?: CharacterClipOptions): AnimationClip;
  /**
   * The character's own file with the motion as one more animation; a character of FBX as glTF.
   * @throws StrutError `licence` where the author forbids it, `bad-input` where the character has no file
   */
  toGLB(motion: StyledPoses): Uint8Array<ArrayBuffer>;
  /** Frees it; what was in the scene is the caller's to take out. */
  dispose(): void;
}

/** Where a bound character came from. */
export interface Origin {
  readonly object: Object3D;
  readonly json: GltfJson | undefined;
  readonly vrm: VrmLike | undefined;
  /** The motions in the file. */
  readonly clips: readonly AnimationClip[];
  /** Sentences for people on what of the file cannot be shown. */
  readonly notes?: readonly string[];
  /** Node of three.js of a number of the file. */
  readonly nodeOf: (index: number) => Object3D | undefined;
  /** Number in the file of a node of three.js. */
  readonly indexOf: (node: Object3D) => number | undefined;
}
