/**
 * Splits and joins binary glTF, and appends an animation: the document is rewritten, the bytes of its buffer stay
 * unchanged, and the new ones are appended.
 */
import { StrutError } from "../engine/errors";
import { BufferBuilder } from "../formats/glb";
import { isRecord } from "./vrm_humanoid";

const [MAGIC, JSON_CHUNK, BINARY_CHUNK] = [0x46546c67, 0x4e4f534a, 0x004e4942];

/** Chunks of a binary glTF. */
export interface GlbChunks {
  readonly json: Record<string, unknown>;
  /** The buffer; empty if there is none. */
  readonly binary: Uint8Array;
}

/** An animation to append; every channel has one key per time. */
interface NewAnimation {
  readonly name: string;
  readonly times: Float32Array;
  readonly channels: readonly {
    /** Index of the node. */
    readonly node: number;
    readonly path: "translation" | "rotation";
    readonly values: Float32Array;
  }[];
}

/**
 * Splits a file. Sizes in it are used only if they fit the file.
 * @throws StrutError `bad-file`
 */
export function chunksOf(file: Uint8Array): GlbChunks {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  if (file.length < 20 || view.getUint32(0, true) !== MAGIC) throw noGlb("This is not a binary glTF file.");
  const version = view.getUint32(4, true);
  if (version !== 2) throw noGlb(`This file is glTF ${version}. Expected version 2.`);
  let json: unknown;
  let binary = new Uint8Array();
  for (let at = 12; at + 8 <= file.length; ) {
    const [length, type] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    const chunk = file.subarray(at + 8, at + 8 + length);
    if (chunk.length < length) throw noGlb("This file is incomplete.");
    if (type === JSON_CHUNK && json === undefined) json = parsed(chunk);
    else if (type === BINARY_CHUNK && binary.length === 0) binary = chunk as Uint8Array<ArrayBuffer>;
    at += 8 + length;
  }
  if (!isRecord(json)) throw noGlb("This file has no glTF document.");
  return { json, binary };
}

/** A length rounded up to a multiple of 4 bytes, the alignment of everything in a file. */
export const paddedLength = (bytes: number): number => bytes + (-bytes & 3);

/**
 * Joins a file.
 * @param parts the buffer, piece by piece; each begins at a multiple of 4 bytes
 */
export function glbOf(json: object, parts: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const textLength = paddedLength(text.length);
  const length = parts.reduce((sum, part) => sum + paddedLength(part.length), 0);
  const out = new Uint8Array(28 + textLength + length);
  const view = new DataView(out.buffer);
  for (const [i, word] of [MAGIC, 2, out.length, textLength, JSON_CHUNK].entries()) view.setUint32(4 * i, word, true);
  out.fill(0x20, 20, 20 + textLength);
  out.set(text, 20);
  view.setUint32(20 + textLength, length, true);
  view.setUint32(24 + textLength, BINARY_CHUNK, true);
  let at = 28 + textLength;
  for (const part of parts) {
    out.set(part, at);
    at += paddedLength(part.length);
  }
  return out;
}

function parsed(chunk: Uint8Array): unknown {
  try {
    return JSON.parse(new TextDecoder().decode(chunk));
  } catch {
    throw noGlb("The glTF document in this file is damaged.");
  }
}

function noGlb(message: string): StrutError {
  return new StrutError({ code: "bad-file", message, hint: "Export the model again as .glb." });
}

/**
 * The file with an additional animation.
 * @throws StrutError `bad-file` if the file is not binary glTF, or refers to its buffer in a way that cannot be
 * extended
 */
export function withAnimation(file: Uint8Array, animation: NewAnimation): Uint8Array<ArrayBuffer> {
  const { json, binary } = chunksOf(file);
  const lists = Object.fromEntries(
    ["buffers", "bufferViews", "accessors", "animations"].map((key) => [key, [...listOf(json, key)]]),
  ) as Record<"buffers" | "bufferViews" | "accessors" | "animations", unknown[]>;
  const first = lists.buffers[0];
  if (lists.buffers.length > 0 && (!isRecord(first) || first.uri !== undefined))
    throw noGlb("This file keeps its data in another file.");

  const added = new BufferBuilder();
  const [views, accessors] = [lists.bufferViews.length, lists.accessors.length];
  const input = added.add(animation.times, "SCALAR", true);
  const channels = animation.channels.filter(({ node }) => node >= 0);
  const samplers = channels.map(({ path, values }) => ({
    input: accessors + input,
    output: accessors + added.add(values, path === "rotation" ? "VEC4" : "VEC3"),
    interpolation: "LINEAR",
  }));
  const start = paddedLength(binary.length);
  const moved = added.views.map((each) => {
    const view = each as { byteOffset: number };
    return { ...view, byteOffset: start + view.byteOffset };
  });
  const renumbered = added.accessors.map((each) => {
    const accessor = each as { bufferView: number };
    return { ...accessor, bufferView: views + accessor.bufferView };
  });
  const byteLength = start + added.length;
  const document = {
    ...json,
    buffers: [{ ...(isRecord(first) ? first : {}), byteLength }, ...lists.buffers.slice(1)],
    bufferViews: [...lists.bufferViews, ...moved],
    accessors: [...lists.accessors, ...renumbered],
    animations: [
      ...lists.animations,
      {
        name: animation.name,
        samplers,
        channels: channels.map(({ node, path }, sampler) => ({ sampler, target: { node, path } })),
      },
    ],
  };
  const bytes = new Uint8Array(added.length);
  added.write(bytes, 0);
  return glbOf(document, [binary, bytes]);
}

function listOf(json: Record<string, unknown>, key: string): readonly unknown[] {
  const list = json[key];
  return Array.isArray(list) ? list : [];
}
