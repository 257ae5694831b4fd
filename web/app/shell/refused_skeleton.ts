/** Handles files whose skeleton the engine cannot recognise as human: the user maps the joints. */
import type { Skeleton } from "../../client/build/protocol";
import type { JointNames } from "../../client/protocol";

/** The skeleton of a BVH file; `undefined` if the file has none that can be read. */
export async function skeletonOf(path: string, bytes: ArrayBuffer): Promise<Skeleton | undefined> {
  // This is rare, so the reader for any skeleton is loaded on demand.
  const { BuildClient } = await import("../../client/build/client");
  const client = new BuildClient();
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

/** Asks the user to map the joints of a skeleton; `undefined` if the user cancels. */
export async function askForJoints({ joints, roles, fault }: Skeleton): Promise<JointNames | undefined> {
  const { askForRoles, jointNames } = await import("../ui/roles_dialog");
  const chosen = await askForRoles({ joints, roles, note: fault });
  return chosen && jointNames(chosen, joints);
}
