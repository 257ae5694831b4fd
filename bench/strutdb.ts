/** The tensors of a `.strutdb` file, which is a safetensors file (`rust/strut-formats/src/strutdb/mod.rs`). */

/** The part of a database that the reference implementation needs. */
export interface Tensors {
  rateHz: number;
  frames: number;
  /** frames × `dofs` degrees of freedom. */
  pose: Float32Array;
  dofs: number;
  /** frames × 21 × 3, heading-free, metres. */
  pointCloud: Float32Array;
  /** frames × styles × `counterpartsPerStyle` fractional rows, −1 for none. */
  counterpart: Float32Array;
  counterpartsPerStyle: number;
  /** Change of the canonical time at each row. */
  timeStep: Float32Array;
  /** frames × 2: 1 while the left and the right foot is planted. */
  contact: Uint8Array;
  styles: string[];
  clips: { action: string; style: string; frames: number; first_frame: number }[];
}

interface Entry {
  shape: number[];
  data_offsets: [number, number];
}

/** Reads a file that the engine has opened before; it is therefore not checked. */
export function readStrutdb(bytes: Uint8Array): Tensors {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const headerLength = Number(view.getBigUint64(0, true));
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(8, 8 + headerLength)));
  const info = JSON.parse(header.__metadata__.strut);
  // Copied, since the offset in the file need not be a multiple of four.
  const copy = (name: string) => {
    const [from, to] = (header[name] as Entry).data_offsets.map((offset) => 8 + headerLength + offset);
    return bytes.slice(from, to);
  };
  const floats = (name: string) => new Float32Array(copy(name).buffer);
  const [frames, dofs] = (header.pose as Entry).shape as [number, number];
  return {
    rateHz: info.rate_hz,
    frames,
    pose: floats("pose"),
    dofs,
    pointCloud: floats("point_cloud"),
    counterpart: floats("counterpart"),
    counterpartsPerStyle: (header.counterpart as Entry).shape[2]!,
    timeStep: floats("time_step"),
    contact: copy("contact"),
    styles: info.styles,
    clips: info.clips,
  };
}
