/**
 * A yardstick: the transfer as one would write it in JavaScript from the paper, loop by loop.
 *
 * The same numbers as the engine's for the default options, but for rounding; `check.ts` compares them.
 * `rust/strut-wasm/src/bench/naive.rs` is the same in Rust.
 */
import type { Yardstick } from "./engines";
import type { Tensors } from "./strutdb";

const WINDOW = 5;
const JOINTS = 21;
const K = 40;
const LAMBDA = 0.1;
const KAPPA = 3;
const RHO = 0.7;
const MAX_FEEDBACK = 0.9;
const DELTA = 0.7;
/** Least of the distances of classes, m². */
const LEAST_DISTANCE = 1e-6;
/** Half-life of what separates expectation and prediction, seconds. */
const HALF_LIFE_SECS = 1 / 120;

interface Near {
  distance: number;
  row: number;
}

/** Local autoregression on the nearest windows of every class, for one target style. */
export class NaiveTransfer implements Yardstick {
  /** For each row the joints that count: x, y, z, times the root of the weight. */
  private readonly points: Float32Array;
  /** Squared length of the window that ends at each row. */
  private readonly norms: Float32Array;
  /** Rows at which a window of each class ends. */
  private readonly windows: number[][] = [];
  private readonly targets: Float32Array;
  private readonly sigma: Float32Array;
  private readonly joints: number[];
  private readonly roots: number[];
  private nearest: Near[][] = [];

  /** @param jointWeights one a joint, 0 where it does not count */
  constructor(
    private readonly db: Tensors,
    style: number,
    jointWeights: Float32Array,
  ) {
    const sum = jointWeights.reduce((a, b) => a + b, 0);
    this.joints = [...jointWeights.keys()].filter((joint) => jointWeights[joint]! > 0);
    this.roots = this.joints.map((joint) => Math.sqrt(jointWeights[joint]! / sum));
    this.points = this.placedPoints();
    this.norms = new Float32Array(db.frames);
    let label = "";
    for (const clip of db.clips) {
      if (label !== `${clip.action}/${clip.style}`) this.windows.push([]);
      label = `${clip.action}/${clip.style}`;
      for (let row = clip.first_frame + WINDOW - 1; row < clip.first_frame + clip.frames; row++) {
        this.windows.at(-1)!.push(row);
        this.norms[row] = this.centred(this.windowEndingAt(row)).norm;
      }
    }
    this.targets = targetRows(db, style);
    this.sigma = standardDeviations(db);
  }

  search(frames: Float32Array, fromClass: number, toClass: number): void {
    const query = new Float32Array(WINDOW * 3 * this.joints.length);
    for (let f = 0; f < WINDOW; f++)
      this.joints.forEach((joint, i) => {
        for (let c = 0; c < 3; c++)
          query[3 * (f * this.joints.length + i) + c] = this.roots[i]! * frames[3 * (f * JOINTS + joint) + c]!;
      });
    const { window, norm } = this.centred(query);
    this.nearest = this.windows.map((rows, label) =>
      label >= fromClass && label < toClass ? this.nearestOf(rows, window, norm) : [],
    );
  }

  private nearestOf(rows: number[], query: Float32Array, norm: number): Near[] {
    const k = rows.length >= 4 * K ? K : Math.min(K, Math.max(Math.floor(rows.length / 4), 5));
    const { points, norms } = this;
    const length = query.length;
    const nearest: Near[] = [];
    for (const row of rows) {
      const first = (row + 1) * (length / WINDOW) - length;
      let heights = 0;
      let real = 0;
      let imaginary = 0;
      for (let i = 0; i < length; i += 3) {
        const ax = query[i]!;
        const az = query[i + 2]!;
        const bx = points[first + i]!;
        const bz = points[first + i + 2]!;
        heights += query[i + 1]! * points[first + i + 1]!;
        real += ax * bx + az * bz;
        imaginary += ax * bz - az * bx;
      }
      const products = heights + Math.sqrt(real * real + imaginary * imaginary);
      const distance = Math.max(norm + norms[row]! - (2 * products) / WINDOW, 0);
      if (nearest.length === k && distance >= nearest[k - 1]!.distance) continue;
      if (nearest.length === k) nearest.pop();
      let at = nearest.length;
      while (at > 0 && nearest[at - 1]!.distance > distance) at--;
      nearest.splice(at, 0, { distance, row });
    }
    return nearest;
  }

  predict(x: Float32Array, xBefore: Float32Array, yBefore: Float32Array, leastWeight: number): Float32Array {
    const { dofs, pose, rateHz } = this.db;
    const { targets } = this;
    const weights = this.classWeights(leastWeight);
    const y = new Float32Array(dofs);
    const step = new Float32Array(dofs);
    for (let d = 0; d < dofs; d++) step[d] = RHO * (x[d]! - xBefore[d]!);
    this.nearest.forEach((nearest, label) => {
      const weight = weights[label]!;
      if (weight === 0) return;
      const first = nearest[0]!.distance;
      const last = nearest.at(-1)!.distance;
      const tapers = nearest.map((n) => (last > first ? (last - n.distance) / (last - first) : 1));
      const total = tapers.reduce((a, b) => a + b, 0);
      for (let d = 0; d < dofs; d++) {
        // Columns: the input one frame before and now, the target one frame before and now.
        const samples = nearest.map(({ row }) => [
          pose[(row - 1) * dofs + d]!,
          pose[row * dofs + d]!,
          targets[(row - 1) * dofs + d]!,
          targets[row * dofs + d]!,
        ]);
        const mean = [0, 0, 0, 0];
        samples.forEach((sample, n) => {
          for (let i = 0; i < 4; i++) mean[i]! += (tapers[n]! * sample[i]!) / total;
        });
        const products = [0, 1, 2].map(() => [0, 0, 0, 0]);
        samples.forEach((sample, n) => {
          for (let i = 0; i < 3; i++)
            for (let j = 0; j < 4; j++)
              products[i]![j]! += tapers[n]! * (sample[i]! - mean[i]!) * (sample[j]! - mean[j]!);
        });
        const sigma = this.sigma[d]!;
        const reach = KAPPA * Math.max(Math.sqrt(products[1]![1]! / total), 0.05 * sigma, 0.005);
        const bias = x[d]! - Math.min(Math.max(x[d]!, mean[1]! - reach), mean[1]! + reach);
        for (let i = 0; i < 3; i++) products[i]![i]! += LAMBDA * total * sigma * sigma;
        const beta = solve(products);
        const predicted =
          mean[3]! +
          RHO * bias +
          beta[0]! * (xBefore[d]! - bias - mean[0]!) +
          beta[1]! * (x[d]! - bias - mean[1]!) +
          beta[2]! * (yBefore[d]! - RHO * bias - mean[2]!);
        y[d]! += weight * predicted;
        step[d]! += weight * (mean[3]! - mean[2]! - RHO * (mean[1]! - mean[0]!));
      }
    });
    const share = 1 - 2 ** (-1 / rateHz / HALF_LIFE_SECS);
    for (let d = 0; d < dofs; d++) {
      const expected = yBefore[d]! + step[d]!;
      y[d] = expected + share * (y[d]! - expected);
    }
    return y;
  }

  neighbours(label: number): number[] {
    return this.nearest[label]!.map((n) => n.row);
  }

  distances(label: number): number[] {
    return this.nearest[label]!.map((n) => n.distance);
  }

  private classWeights(leastWeight: number): number[] {
    const distances = this.nearest.map((nearest) =>
      nearest.length > 0 ? nearest.reduce((sum, n) => sum + n.distance, 0) / nearest.length : Infinity,
    );
    const least = Math.max(Math.min(...distances), LEAST_DISTANCE);
    const weights = distances.map((distance) => Math.exp(Math.min(least - distance, 0) / (DELTA * least)));
    const kept = weights.map((weight) => (weight < leastWeight ? 0 : weight));
    const keptSum = kept.reduce((a, b) => a + b, 0);
    return kept.map((weight) => weight / keptSum);
  }

  /** The joints of every row where its clip walks: the row's velocities summed up. */
  private placedPoints(): Float32Array {
    const { pose, dofs, pointCloud, clips, rateHz, frames } = this.db;
    const points = new Float32Array(frames * this.joints.length * 3);
    let out = 0;
    for (const clip of clips) {
      let [x, z, heading] = [0, 0, 0];
      for (let row = clip.first_frame; row < clip.first_frame + clip.frames; row++) {
        const [velocityX, velocityZ, turn] = pose.subarray((row + 1) * dofs - 3, (row + 1) * dofs);
        if (row > clip.first_frame) heading += turn! / rateHz;
        const [sin, cos] = [Math.sin(heading), Math.cos(heading)];
        if (row > clip.first_frame) {
          x += (cos * velocityX! + sin * velocityZ!) / rateHz;
          z += (cos * velocityZ! - sin * velocityX!) / rateHz;
        }
        this.joints.forEach((joint, i) => {
          const [px, py, pz] = pointCloud.subarray(3 * (row * JOINTS + joint), 3 * (row * JOINTS + joint) + 3);
          points[out++] = this.roots[i]! * (x + cos * px! + sin * pz!);
          points[out++] = this.roots[i]! * py!;
          points[out++] = this.roots[i]! * (z + cos * pz! - sin * px!);
        });
      }
    }
    return points;
  }

  private windowEndingAt(row: number): Float32Array {
    const size = 3 * this.joints.length;
    return this.points.slice((row + 1 - WINDOW) * size, (row + 1) * size);
  }

  /** A window with its middle above the origin, and its squared length. */
  private centred(window: Float32Array): { window: Float32Array; norm: number } {
    const { roots } = this;
    let x = 0;
    let z = 0;
    for (let p = 0; p < window.length / 3; p++) {
      x += (roots[p % roots.length]! * window[3 * p]!) / WINDOW;
      z += (roots[p % roots.length]! * window[3 * p + 2]!) / WINDOW;
    }
    let norm = 0;
    for (let p = 0; p < window.length / 3; p++) {
      window[3 * p]! -= roots[p % roots.length]! * x;
      window[3 * p + 2]! -= roots[p % roots.length]! * z;
      norm += (window[3 * p]! ** 2 + window[3 * p + 1]! ** 2 + window[3 * p + 2]! ** 2) / WINDOW;
    }
    return { window, norm };
  }
}

/** What every row becomes in a style: the mean of its counterparts, or itself where there is none. */
function targetRows(db: Tensors, style: number): Float32Array {
  const { pose, dofs, frames, counterpart, counterpartsPerStyle: most, styles } = db;
  const targets = pose.slice();
  for (let row = 0; row < frames; row++) {
    const first = (row * styles.length + style) * most;
    const rows = [...counterpart.subarray(first, first + most)].filter((at) => at >= 0);
    if (rows.length === 0) continue;
    for (let d = 0; d < dofs; d++) {
      let sum = 0;
      for (const at of rows) {
        const i = Math.floor(at);
        const j = Math.min(i + 1, frames - 1);
        sum += pose[i * dofs + d]! + (at - i) * (pose[j * dofs + d]! - pose[i * dofs + d]!);
      }
      targets[row * dofs + d] = sum / rows.length;
    }
  }
  return targets;
}

function standardDeviations({ pose, dofs, frames }: Tensors): Float32Array {
  const sigma = new Float32Array(dofs);
  for (let d = 0; d < dofs; d++) {
    let mean = 0;
    for (let row = 0; row < frames; row++) mean += pose[row * dofs + d]! / frames;
    let variance = 0;
    for (let row = 0; row < frames; row++) variance += (pose[row * dofs + d]! - mean) ** 2 / frames;
    sigma[d] = Math.max(Math.sqrt(variance), 1e-4);
  }
  return sigma;
}

/** Weights of the regressors by Gaussian elimination; that of yₜ₋₁ is limited, and the other two solved for it. */
function solve(m: number[][]): number[] {
  for (let i = 0; i < 3; i++)
    for (let j = i + 1; j < 3; j++) {
      const factor = m[j]![i]! / m[i]![i]!;
      for (let k = i; k < 4; k++) m[j]![k]! -= factor * m[i]![k]!;
    }
  const feedback = Math.min(Math.max(m[2]![3]! / m[2]![2]!, -MAX_FEEDBACK), MAX_FEEDBACK);
  const second = (m[1]![3]! - m[1]![2]! * feedback) / m[1]![1]!;
  return [(m[0]![3]! - m[0]![2]! * feedback - m[0]![1]! * second) / m[0]![0]!, second, feedback];
}
