// The walk that the page shows until the engine is loaded (web/engine/first_steps.ts).

/** Floats of a pose: root x y z, then a quaternion x y z w per joint. */
const POSE_FLOATS = 87;
/** Quantisation steps per metre and per radian: the error is at most a millimetre or 0.06° per axis. */
const STEPS = 512;

/** Packs poses at `rateHz`, before compression. */
export function packFirstSteps(poses, rateHz) {
  const frames = poses.length / POSE_FLOATS;
  const rows = Array.from({ length: frames }, (_, f) => rowOf(poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS)));
  const bytes = [];
  for (const number of [frames, rateHz, STEPS]) write(bytes, number);
  for (let column = 0; column < rows[0].length; column++) {
    let [before, last] = [0, 0];
    for (const row of rows) {
      const now = Math.round(row[column] * STEPS);
      write(bytes, now - 2 * last + before);
      [before, last] = [last, now];
    }
  }
  return Uint8Array.from(bytes);
}

/** Returns the root and a rotation vector per joint. */
function rowOf(pose) {
  const row = [...pose.subarray(0, 3)];
  for (let at = 3; at < pose.length; at += 4) {
    const [x, y, z, w] = pose.subarray(at, at + 4);
    const sine = Math.hypot(x, y, z);
    const scale = (Math.sign(w) || 1) * (sine < 1e-9 ? 2 : (2 * Math.atan2(sine, Math.abs(w))) / sine);
    row.push(scale * x, scale * y, scale * z);
  }
  return row;
}

/** Appends an integer in zigzag LEB128. */
function write(bytes, number) {
  let zigzag = ((number << 1) ^ (number >> 31)) >>> 0;
  for (; zigzag > 127; zigzag >>>= 7) bytes.push((zigzag & 127) | 128);
  bytes.push(zigzag);
}
