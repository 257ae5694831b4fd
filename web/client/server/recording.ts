/** A recording of what was driven: the neutral frames of the last minutes, and the styles in which they were displayed. */
import type { StyleKey } from "../../engine/types";
import { POSE_FLOATS } from "../../humanoid";

/** Frames per block, and maximum number of blocks: five minutes at 60 Hz. */
const BLOCK = 1800;
const BLOCKS = 10;
/** A key is made when a weight changed by more than this, and at most once in this many frames. */
const MOVED = 0.02;
const KEY_FRAMES = 6;
/** Maximum number of keys of a track. */
const MAX_KEYS = 1000;

/** Weights, one per style, at a frame. */
interface Key {
  frame: number;
  weights: Float32Array;
}

export class Recording {
  /** Number of all frames ever added. */
  private count = 0;
  /** Index of the first frame that is kept. */
  private first = 0;
  private blocks: Float32Array[] = [];
  private keys: Key[] = [];
  /** Weights of the last frame. */
  private before: Float32Array | undefined;

  /** @param styles names of the styles */
  constructor(private readonly styles: readonly string[]) {}

  get frames(): number {
    return this.count - this.first;
  }

  /** Adds a frame and the styles in which it is displayed. */
  add(pose: Float32Array, weights: Float32Array): void {
    const at = (this.count - this.first) % BLOCK;
    if (at === 0) {
      this.blocks.push(new Float32Array(BLOCK * POSE_FLOATS));
      // One block more than the limit, as the newest is not full.
      if (this.blocks.length > BLOCKS + 1) {
        this.blocks.shift();
        this.first += BLOCK;
        this.keys = this.keys.slice(
          Math.max(
            0,
            this.keys.findLastIndex(({ frame }) => frame <= this.first),
          ),
        );
      }
    }
    this.blocks.at(-1)!.set(pose, at * POSE_FLOATS);
    this.addKey(weights);
    this.count += 1;
  }

  /** The poses of the last frames, as many as exist. */
  last(frames: number): Float32Array {
    const count = Math.min(frames, this.frames);
    const poses = new Float32Array(count * POSE_FLOATS);
    for (let i = 0; i < count; i++) {
      const frame = this.frames - count + i;
      const at = (frame % BLOCK) * POSE_FLOATS;
      poses.set(this.blocks[Math.floor(frame / BLOCK)]!.subarray(at, at + POSE_FLOATS), i * POSE_FLOATS);
    }
    return poses;
  }

  /** The styles of the last frames over time; the first of them is frame 0. */
  track(frames: number): StyleKey[] {
    const begin = this.count - Math.min(frames, this.frames);
    const before = this.keys.findLastIndex(({ frame }) => frame <= begin);
    let keys = this.keys.slice(Math.max(before, 0)).map(({ frame, weights }) => ({ frame: frame - begin, weights }));
    if (keys[0]) keys[0].frame = 0;
    while (keys.length > MAX_KEYS) keys = keys.filter((_, i) => i % 2 === 0 || i === keys.length - 1);
    return keys.map(({ frame, weights }) => ({ frame, styles: this.named(weights) }));
  }

  private addKey(weights: Float32Array): void {
    const last = this.keys.at(-1);
    const rests = this.before !== undefined && !hasMoved(this.before, weights, 0);
    this.before ??= weights.slice();
    this.before.set(weights);
    // The final weights become a key, however near the last key is.
    if (last && (this.count - last.frame < KEY_FRAMES || !hasMoved(last.weights, weights, rests ? 0 : MOVED))) return;
    // Between keys weights change linearly, so the value at which they stayed becomes a key, too.
    if (last && this.count - last.frame > KEY_FRAMES)
      this.keys.push({ frame: this.count - KEY_FRAMES, weights: last.weights });
    this.keys.push({ frame: this.count, weights: weights.slice() });
  }

  private named(weights: Float32Array): Record<string, number> {
    const entries = this.styles.map((name, i): [string, number] => [name, Math.round(weights[i]! * 1000) / 1000]);
    return Object.fromEntries(entries.filter(([, weight]) => weight !== 0));
  }
}

function hasMoved(from: Float32Array, to: Float32Array, least: number): boolean {
  return from.some((weight, i) => Math.abs(weight - to[i]!) > least);
}
