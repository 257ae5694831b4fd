// Memory that is reachable in a page or a worker after garbage collection.

/**
 * Returns bytes measured by a session of the DevTools protocol: code, which the browser recompiles as it runs, and
 * everything else.
 */
export async function reachable(client) {
  const chunks = [];
  const keep = ({ chunk }) => chunks.push(chunk);
  client.on("HeapProfiler.addHeapSnapshotChunk", keep);
  await client.send("HeapProfiler.takeHeapSnapshot", { reportProgress: false });
  client.off("HeapProfiler.addHeapSnapshotChunk", keep);
  const { snapshot, nodes } = JSON.parse(chunks.join(""));
  const { node_fields: fields, node_types: types } = snapshot.meta;
  const [type, size] = [fields.indexOf("type"), fields.indexOf("self_size")];
  const bytes = { code: 0, data: 0 };
  for (let i = 0; i < nodes.length; i += fields.length)
    bytes[types[type][nodes[i + type]] === "code" ? "code" : "data"] += nodes[i + size];
  return bytes;
}
