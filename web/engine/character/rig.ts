/** The engine's side of a character: roles of its joints, and poses as rotations of its bones. Runs on the calling thread. */
import { DEFAULT_PROPORTIONS, POSE_FLOATS } from "../../humanoid";
import { Handle } from "../handle";
import { type CharacterGlue, characterPackage } from "./wasm";

/** A skeleton in its bind pose, in which the character was modelled. Parents come before their children. */
export interface Skeleton {
  /** Names as in the file. */
  readonly names: readonly string[];
  /** Parent of each joint; −1 for joint 0, the only root. */
  readonly parents: Int32Array;
  /** From the parent to the joint in the bind pose, along the world axes: xyz, any unit. */
  readonly offsets: Float32Array;
  /** World rotation of each joint in the bind pose, xyzw. */
  readonly bind: Float32Array;
  /** Local rotation of each joint at rest, xyzw. Joints without a role keep it. */
  readonly local: Float32Array;
}

/** The joint of each of the 21 roles, −1 where it cannot be found. @throws StrutError `bad-file` */
export function likelyRoles(glue: CharacterGlue, { names, parents, offsets }: Skeleton, roles: Int32Array): Int32Array {
  return characterPackage.guarded(() => glue.Character.likelyRoles([...names], parents, offsets, roles));
}

/** Feet that are children of the root instead of their legs. @throws StrutError `bad-file` */
export function looseFeet(glue: CharacterGlue, { names, parents, offsets }: Skeleton): { foot: number; leg: number }[] {
  const pairs = characterPackage.guarded(() => glue.Character.looseFeet([...names], parents, offsets));
  return Array.from({ length: pairs.length / 2 }, (_, i) => ({ foot: pairs[2 * i]!, leg: pairs[2 * i + 1]! }));
}

/** A bound skeleton. */
export class CharacterRig extends Handle<InstanceType<CharacterGlue["Character"]>> {
  /** Joint of each role; −1 for a role without a joint. */
  readonly roles: Int32Array;
  /** Confidence in the roles, 0–1. */
  readonly confidence: number;
  /** Sentences for the user on what was matched and assumed. */
  readonly notes: readonly string[];
  /** Rotation from the axes of the file to Strut's, xyzw: the identity if +Y is up. */
  readonly worldFromFile: Float32Array;
  /**
   * Output of the last {@link apply}: translation of the hips in their parent's frame, in the skeleton's unit, then the
   * local rotation of every joint, xyzw.
   */
  readonly frame: Float32Array;
  /** A copy of the pose, used if the caller's is not a `Float32Array`. */
  readonly #pose = new Float32Array(POSE_FLOATS);

  /** The body on which the poses are defined; initially the mannequin's. */
  #body: ArrayLike<number> = DEFAULT_PROPORTIONS;

  /**
   * Binds a skeleton.
   * @param glue the package, loaded
   * @param roles joint of each known role; −1 where it is to be found
   * @param metresPerUnit length of the skeleton's unit
   * @throws StrutError `bad-file` with what the skeleton lacks
   */
  constructor(glue: CharacterGlue, skeleton: Skeleton, roles: Int32Array, metresPerUnit: number) {
    const { names, parents, offsets, bind, local } = skeleton;
    super(
      characterPackage.guarded(
        () => new glue.Character([...names], parents, offsets, bind, local, roles, metresPerUnit),
      ),
      "character",
    );
    this.roles = this.raw.roles();
    this.confidence = this.raw.confidence();
    this.notes = this.raw.notes();
    this.worldFromFile = this.raw.worldFromFile();
    this.frame = new Float32Array(this.raw.frameFloats());
  }

  /** The body in metres: 21 × xyz; the first is the height of the hips above the soles. */
  get proportions(): Float32Array {
    return this.raw.proportions();
  }

  /**
   * Sets the height of the soles in the bind pose, along the body's up axis in the skeleton's unit. Without a height it
   * is guessed from the ankles, as before the first call.
   * @param points points of the feet that can touch the ground: side (0 left), part (0 foot, 1 toes) and xyz from the
   * part's joint
   */
  setSole(height: number | undefined, points: Float32Array = new Float32Array()): void {
    characterPackage.guarded(() => this.raw.setSole(height, points));
  }

  /** Sets the body on which the poses are defined, 21 × xyz in metres. @throws StrutError `bad-input` */
  setBody(proportions: ArrayLike<number>): void {
    const body = Float32Array.from(proportions);
    characterPackage.guarded(() => this.raw.setBody(body));
    this.#body = body;
  }

  /** Runs a conversion with another body, then restores the previous body. @throws StrutError `bad-input` */
  onBody<T>(proportions: ArrayLike<number>, convert: () => T): T {
    const before = this.#body;
    this.setBody(proportions);
    try {
      return convert();
    } finally {
      this.setBody(before);
    }
  }

  /**
   * Poses on the body of {@link setBody}, 87 numbers a frame.
   * @param locals local translation, xyz in the skeleton's unit, and rotation, xyzw, of every joint in every frame
   */
  toPoses(locals: Float32Array): Float32Array {
    return characterPackage.guarded(() => this.raw.toPoses(locals));
  }

  /** Fills `into` with the pose that the last {@link apply} produced, on the character's own body. */
  readPose(into: Float32Array): void {
    this.raw.pose(into);
  }

  /** Fills {@link frame} with a pose of `POSE_FLOATS` numbers. @throws StrutError `bad-input` unless they are finite */
  apply(pose: ArrayLike<number>): void {
    let floats = pose;
    if (!(floats instanceof Float32Array)) {
      if (floats.length === POSE_FLOATS) this.#pose.set(floats);
      floats = this.#pose;
    }
    characterPackage.guarded(() => this.raw.apply(floats as Float32Array, this.frame));
  }
}
