// Characters in three.js, docs/characters.md and the package's README: `npm test` checks the types.
import { loadStrut } from "strut-motion";
import { Scene } from "three";

const scene = new Scene();
const strut = await loadStrut();
const database = await strut.openDatabase("strut:walk");
const styled = await strut.stylize(await strut.openMotion("strut:neutral-walk"), database, { styles: { proud: 1 } });

// anchor pose
import { loadCharacter } from "strut-motion/three";

const character = await loadCharacter("figure.vrm", { accept: (licence) => confirm(licence.title) });
scene.add(character.object);
character.setBody(database.info.proportions); // the body that the poses are on
character.apply(styled.poses.subarray(0, 87)); // the first pose
// end pose

const dtSecs = 1 / 60;

// anchor more
character.update(dtSecs); // once a frame: hair and clothes, with three-vrm
const glb = character.toGLB(styled); // the model's own file with one more animation, if its author allows that
// end more

console.log(glb);

// anchor motions
import { loadMotions } from "strut-motion/three";

const [motion] = await loadMotions("dance.vrma"); // also of GLB, VRM and FBX, with a figure or without
const dance = await strut.openMotion(motion.toBVH());
// end motions

console.log(dance);

/** A list of your own: the joint of each role that is missing, by name. */
const chooseFrom = (joints: readonly string[], missing: readonly string[]) =>
  Object.fromEntries(missing.map((role, i) => [role, joints[i]!]));

// anchor joints
import { JointsError } from "strut-motion/three";

const figure = await loadCharacter("figure.glb").catch((error) => {
  if (!(error instanceof JointsError)) throw error;
  return loadCharacter("figure.glb", { roles: { ...error.roles, ...chooseFrom(error.joints, error.missing) } });
});
// end joints

console.log(figure);
