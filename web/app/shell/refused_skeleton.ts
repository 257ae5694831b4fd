/** Files whose skeleton the engine cannot read as a human's: a person says which joint is which. */
import type { Skeleton } from "../../client/build/protocol";
import type { JointNames } from "../../client/protocol";

/** The skeleton of a BVH file; `undefined` where the file has none that can be read. */
export async function skeletonOf(path: string, bytes: ArrayBuffer): Promise<Skeleton | undefined> {
  // Few files come here: what reads any skeleton is loaded for them alone.
  const { createBuildClient } = await import("../../client/build/client");
  const client = createBuildClient();
  const skeletons: Skeleton[] = [];
  try {
    await client.open([{ path, file: new File([bytes], path) }]);
    await client.readAll((event) => skeletons.push(...event.skeletons));
  } catch {
    return undefined;
  } finally {
    client.dispose();
  }
  return skeletons[0];
}

/** Asks which joint of a skeleton is which; `undefined` where nobody says. */
export async function askForJoints({ joints, roles, fault }: Skeleton): Promise<JointNames | undefined> {
  const { askForRoles, jointNames } = await import("../ui/roles_dialog");
  const chosen = await askForRoles({ joints, roles, note: fault });
  return chosen && jointNames(chosen, joints);
}
