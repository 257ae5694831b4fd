/** A bound character, to which pages apply poses. */
import type { AnimationClip, Object3D } from "three";
import { StrutError } from "../engine/errors";
import { JOINT, type Role, restPose } from "../humanoid";
import { type Bound, bind, originOf, roleNames } from "./bind";
import { characterClip, keysOf } from "./clip";
import { withAnimation } from "./glb_patch";
import { type Licence, licenceOf } from "./licence";
import { motionsOf } from "./motions";
import type {
  BindOptions,
  Character,
  CharacterClipOptions,
  CharacterMotion,
  GltfLike,
  Origin,
  StyledPoses,
  VrmLike,
} from "./types";

/** Longest step of the spring bones, seconds: longer ones make springs explode. */
const LONGEST_STEP = 1 / 30;

/** Additional results of a loader. */
export interface Loaded {
  /** The model as binary glTF, for exports. */
  readonly file?: Uint8Array | undefined;
  /** Frees the loader's resources. */
  readonly free?: () => void;
}

/**
 * Binds a character that already exists in three.js.
 * @throws StrutError `bad-file` with what the model lacks, `bad-input` if an option does not fit it, `load`
 */
export function bindCharacter(root: Object3D | VrmLike | GltfLike, options?: BindOptions): Promise<Character> {
  return bindLoaded(originOf(root), options);
}

/** Binds a loaded character. */
export async function bindLoaded(
  origin: Origin,
  options?: BindOptions,
  loaded: Loaded = {},
): Promise<Character & Releasable> {
  const bound = await bind(origin, options);
  if (origin.vrm) origin.vrm.humanoid.autoUpdateHumanBones = false;
  return new BoundCharacter(origin, bound, loaded);
}

/** The licence in the file, or in the meta that three-vrm read from it, which has the fields of VRM 1 or of VRM 0. */
function licenceOfOrigin({ json, vrm }: Origin): Licence | undefined {
  if (json) return licenceOf(json);
  const meta = vrm?.meta as { metaVersion?: unknown } | undefined;
  if (!meta) return undefined;
  return licenceOf({ extensions: meta.metaVersion === "0" ? { VRM: { meta } } : { VRMC_vrm: { meta } } });
}

/** An object that releases its engine resources and keeps what was loaded. */
interface Releasable {
  release(): void;
}

class BoundCharacter implements Character, Releasable {
  readonly object: Object3D;
  readonly joints: readonly string[];
  readonly roles: Readonly<Partial<Record<Role, string>>>;
  readonly confidence: number;
  readonly notes: readonly string[];
  readonly warnings: readonly string[];
  readonly licence: Licence | undefined;
  readonly motions: readonly CharacterMotion[];
  readonly #origin: Origin;
  readonly #bound: Bound;
  readonly #loaded: Loaded;
  readonly #hips: Object3D;
  readonly #driven: { node: Object3D; offset: number }[];
  readonly #pose = restPose();

  constructor(origin: Origin, bound: Bound, loaded: Loaded) {
    [this.#origin, this.#bound, this.#loaded] = [origin, bound, loaded];
    this.object = origin.object;
    this.joints = bound.joints.names;
    this.roles = roleNames(bound);
    this.confidence = bound.rig.confidence;
    this.notes = bound.notes;
    this.warnings = bound.warnings;
    this.motions = motionsOf(origin, bound.rig.proportions, (convert) => convert(bound));
    this.licence = licenceOfOrigin(origin);
    this.#hips = bound.joints.nodes[bound.roles[JOINT.hips]!]!;
    // Skinned meshes leave the bounds of their bind pose; three.js would cull them.
    for (const { mesh } of bound.joints.skins) mesh.frustumCulled = false;
    this.#driven = Array.from(bound.driven, (joint) => ({ node: bound.joints.nodes[joint]!, offset: 3 + 4 * joint }));
  }

  get proportions(): Float32Array {
    return this.#bound.rig.proportions;
  }

  setBody(proportions: ArrayLike<number>): void {
    this.#bound.rig.setBody(proportions);
  }

  apply(pose: ArrayLike<number>): void {
    const { rig, hipsScale, moved, joints } = this.#bound;
    rig.apply(pose);
    const { frame } = rig;
    this.#hips.position.set(frame[0]! * hipsScale, frame[1]! * hipsScale, frame[2]! * hipsScale);
    for (const { node, offset } of this.#driven) node.quaternion.fromArray(frame, offset);
    moved.update(frame);
    for (const [i, joint] of moved.joints.entries()) {
      const node = joints.nodes[joint]!;
      node.position.fromArray(moved.positions, 3 * i);
      node.quaternion.fromArray(moved.rotations, 4 * i);
    }
  }

  get pose(): Readonly<Float32Array> {
    this.#bound.rig.readPose(this.#pose);
    return this.#pose;
  }

  update(dtSecs: number): void {
    this.#origin.vrm?.update(Math.min(Math.max(dtSecs, 0), LONGEST_STEP));
  }

  settle(): void {
    this.#origin.vrm?.springBoneManager?.reset();
  }

  toClip(motion: StyledPoses, options: CharacterClipOptions = {}): AnimationClip {
    return characterClip(this.#bound, this.object, this.#origin.vrm, motion, options);
  }

  toGLB(motion: StyledPoses): Uint8Array<ArrayBuffer> {
    if (this.licence && !this.licence.mayExport) {
      const message = "This model’s licence does not allow redistribution with a new motion.";
      const hint = "Export the motion alone: toVRMA, toBVH or toClip.";
      throw new StrutError({ code: "licence", message, hint });
    }
    const { file } = this.#loaded;
    if (!file) {
      const message = "This character was loaded without its file, so no motion can be added to it.";
      throw new StrutError({ code: "bad-input", message, hint: "Load it with loadCharacter, without glb: false." });
    }
    const { joints, roles, driven } = this.#bound;
    const { times, hips, rotations, places } = keysOf(this.#bound, motion, false);
    const index = (joint: number) => this.#origin.indexOf(joints.nodes[joint]!) ?? -1;
    return withAnimation(file, {
      name: motion.name,
      times,
      channels: [
        { node: index(roles[JOINT.hips]!), path: "translation", values: hips },
        ...Array.from(places, ([joint, values]) => ({ node: index(joint), path: "translation" as const, values })),
        ...Array.from(driven, (joint, i) => ({
          node: index(joint),
          path: "rotation" as const,
          values: rotations[i]!,
        })),
      ],
    });
  }

  release(): void {
    this.#bound.rig.dispose();
  }

  dispose(): void {
    this.release();
    this.#loaded.free?.();
  }
}
