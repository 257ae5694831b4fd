/** Loads characters and motions from files: GLB, VRM 0 and 1, FBX, and for motions VRM Animation. */
import { Group, type Object3D } from "three";
import { characterPackage } from "../engine/character/wasm";
import { cancelled, StrutError } from "../engine/errors";
import type { CallOptions } from "../engine/types";
import { DEFAULT_PROPORTIONS, JOINT } from "../humanoid";
import { type Bound, boundWith } from "./bind";
import { bindLoaded } from "./character";
import { type Licence, licenceOf } from "./licence";
import { motionsOf } from "./motions";
import {
  bytesOf,
  type CharacterSource,
  free,
  type ImportVrm,
  type ReadModel,
  type ReadOptions,
  reading,
  readModel,
} from "./read";
import type { BindOptions, Character, CharacterMotion, Origin } from "./types";
import { vrmaOf } from "./vrm_humanoid";

/** Height of the mannequin and of its hips, metres. */
const MANNEQUIN_METRES = 1.75;
const HIPS_METRES = DEFAULT_PROPORTIONS[3 * JOINT.hips + 1]!;
/** Bodies between these shares of the mannequin's height keep their size: children, toys and giants. */
const [SHORTEST, TALLEST] = [0.2, 6];

/** Options of {@link loadCharacter}. */
export interface LoadCharacterOptions extends CallOptions, BindOptions {
  /** Asked if the author does not allow everyone to perform the character. Without it, the character is refused. */
  accept?: (licence: Licence) => boolean | Promise<boolean>;
  /**
   * Whether {@link Character.toGLB} will be needed; `true` by default. An FBX model is then converted to glTF while
   * loading.
   */
  glb?: boolean;
}

/**
 * Loads and binds a character.
 * @param importVrm imports three-vrm if the file is a VRM; without it hair and clothes do not swing
 * @throws StrutError `bad-file` if the file is invalid, `licence` if its use was not accepted, `load` if it cannot be
 * loaded, `cancelled`
 */
export async function loadCharacter(
  source: CharacterSource,
  options: LoadCharacterOptions = {},
  importVrm?: ImportVrm,
): Promise<Character> {
  const { accept, glb = true } = options;
  const inspect: ReadOptions["inspect"] = (document) => checkLicence(licenceOf(document), accept);
  const model = await loaded(source, "character", options, { inspect, wantsGlb: glb, importVrm });
  const { object } = model.origin;
  try {
    const loaded = { file: model.glb, free: () => free(object) };
    const bind = (origin: Origin, given: BindOptions) => reading(() => bindLoaded(origin, given, loaded));
    const unit = unitOf(model, options);
    let character = await bind(model.origin, unit);
    const height = character.proportions[3 * JOINT.hips + 1]! / HIPS_METRES;
    if (options.metresPerUnit === undefined && !(height > SHORTEST && height < TALLEST)) {
      character.release();
      const scale = 1 / height;
      const notes = [...(model.origin.notes ?? []), sizeNote(height)];
      const resized = { ...model.origin, object: scaledBy(object, scale), notes };
      character = await bind(resized, { ...unit, metresPerUnit: (unit.metresPerUnit ?? 1) * scale });
    }
    options.onProgress?.({ label: "Reading the character", fraction: 1 });
    return character;
  } catch (thrown) {
    free(object);
    throw thrown;
  }
}

/**
 * The motions of a file, with or without a character in it. They hold no engine memory: it is allocated when they are
 * read, and then freed.
 * @param call also the known joints, as for {@link loadCharacter}
 * @throws StrutError `bad-file` if the file is invalid, `load` if it cannot be loaded, `cancelled`
 */
export async function loadMotions(
  source: CharacterSource,
  call: CallOptions & BindOptions = {},
): Promise<CharacterMotion[]> {
  let isVrma = false;
  const inspect: ReadOptions["inspect"] = (document) => {
    isVrma = vrmaOf(document) !== undefined;
  };
  const model = await loaded(source, "motions", call, { inspect });
  const { origin } = model;
  try {
    if (origin.clips.length === 0) return [];
    const glue = await characterPackage.load();
    // A VRM Animation stands on the ground.
    const { roles, soleHeight = isVrma ? 0 : undefined, metresPerUnit } = call;
    const options = unitOf(model, {
      ...(roles && { roles }),
      ...(soleHeight !== undefined && { soleHeight }),
      ...(metresPerUnit !== undefined && { metresPerUnit }),
    });
    const on = <T>(convert: (bound: Bound) => T): T => {
      const bound = boundWith(glue, origin, options, false);
      try {
        bound.rig.setBody(bound.rig.proportions);
        return convert(bound);
      } finally {
        bound.rig.dispose();
      }
    };
    const motions = motionsOf(
      origin,
      on(({ rig }) => rig.proportions),
      on,
    );
    call.onProgress?.({ label: "Reading the motions", fraction: 1 });
    return motions;
  } finally {
    free(origin.object);
  }
}

/** An object in a parent that is scaled to metres, like a human body. */
function scaledBy(object: Object3D, scale: number): Object3D {
  const group = new Group();
  group.add(object);
  group.scale.setScalar(scale);
  group.scale.multiply(object.scale);
  object.scale.setScalar(1);
  group.animations = object.animations;
  return group;
}

function sizeNote(height: number): string {
  const metres = MANNEQUIN_METRES * height;
  const tall = metres >= 1 ? `${metres.toFixed(0)} m` : `${(100 * metres).toPrecision(2)} cm`;
  return `This body is about ${tall} tall in its file; it was scaled to the size of a person.`;
}

/** Loads and reads a file. */
async function loaded(
  source: CharacterSource,
  what: string,
  { signal, onProgress }: CallOptions,
  options: ReadOptions,
): Promise<ReadModel> {
  const stop = () => {
    if (signal?.aborted) throw cancelled(signal.reason);
  };
  stop();
  onProgress?.({ label: `Loading the ${what}`, fraction: 0 });
  const file = await bytesOf(source, signal);
  stop();
  onProgress?.({ label: `Reading the ${what}`, fraction: 0.5 });
  const model = await readModel(file, options);
  if (signal?.aborted) free(model.origin.object);
  stop();
  return model;
}

/** The options of a model's binding, with the unit of its format. */
function unitOf({ metresPerUnit }: ReadModel, options: BindOptions): BindOptions {
  return metresPerUnit === undefined ? options : { metresPerUnit, ...options };
}

/** @throws StrutError `licence` unless everyone may perform the character or the licence was accepted */
async function checkLicence(licence: Licence | undefined, accept: LoadCharacterOptions["accept"]): Promise<void> {
  if (!licence || licence.everybody || (await accept?.(licence))) return;
  const message = "The author of this model does not allow everyone to perform with it.";
  throw new StrutError({
    code: "licence",
    message,
    hint: "Choose another model, or accept its terms if you have permission.",
  });
}
