/** Databases for tests, built as the page builds them. */
import { BuildClient } from "../web/client/build/client";
import { InlineBuildWorker } from "./inline_build_worker";

/** Builds a `.strutdb` file of clips by their names, `action_style_take.bvh`. */
export async function databaseOf(clips: Readonly<Record<string, string>>): Promise<Uint8Array> {
  const client = new BuildClient(() => new InlineBuildWorker());
  try {
    const paths = Object.keys(clips);
    await client.open(paths.map((path) => ({ path, file: new File([clips[path]!], path) })));
    const labels = await client.label("{action}_{style}_{take}.bvh", undefined);
    const files = labels.map((label, index) => {
      if ("reason" in label) throw new Error(label.reason);
      return { index, path: paths[index]!, ...label, source: "", licence: "", roles: undefined };
    });
    return new Uint8Array(await (await client.build(files, "neutral")).file.arrayBuffer());
  } finally {
    client.dispose();
  }
}
