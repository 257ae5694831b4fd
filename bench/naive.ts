/**
 * Reference implementation in JavaScript: the transfer as written in the paper, loop by loop.
 *
 * Its numbers equal the engine's for the default options, except for rounding; `yardstick_bench.ts` compares them.
 * `rust/strut-wasm/src/engine/bench/naive.rs` is the same in Rust.
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
const DELTA = 0.35;
/** D at which an input is half known, m². */
const HALF_KNOWN = 0.0025;
/** A counterpart that moves by this number of rows or more in a frame is not continuous. */
const JUMP_ROWS = 4;
/** Lower bound of class distances, m². */
const LEAST_DISTANCE = 1e-6;
/**
 * Half-life of the difference between expectation and prediction for known input, seconds; the factor for unknown
 * input; and D of the nearest neighbour halfway between, m².
 */
const HALF_LIFE_SECS = 1 / 120;
const LONGEST = 6;
const HALF_UNKNOWN = 0.0016;
/**
 * Number of windows with similar legs that vote on foot contacts; differences of a point's height, metres, and speed,
 * m/s, at which a vote's weight halves; and the least sum of their squares.
 */
const VOTERS = 40;
const SAME_HEIGHT = 0.01;
const SAME_SPEED = 0.15;
const SAME = 0.05;
/**
 * Number of leg points, which come first in a frame, and index of the first of both ankles and both toes, which are the
 * last of them.
 */
const LEG_POINTS = 8;
const FEET = 4;

interface Near {
  distance: number;
  row: number;
}

/** Local autoregression on the nearest windows of every class, for one target style. */
export class NaiveTransfer implements Yardstick {
  /** The weighted joints of each row: x, y, z, times the root of the weight. */
  private readonly points: Float32Array;
  /** Squared length of the window that ends at each row, with all points and with the leg points. */
  private readonly norms: [Float32Array, Float32Array];
  /** Rows at which a window of each class ends. */
  private readonly windows: number[][] = [];
  private readonly targets: Float32Array;
  private readonly stepSecs: Float32Array;
  private readonly sigma: Float32Array;
  private readonly stepSigma: Float32Array;
  private readonly joints: number[];
  private readonly roots: number[];
  private nearest: Near[][] = [];
  /** Weight of each class in the last prediction. */
  private weights: number[] = [];

  /**
   * @param jointWeights one per joint, 0 for an unused joint
   * @param legs joints of the legs, the last four both ankles and both toes
   */
  constructor(
    private readonly db: Tensors,
    style: number,
    jointWeights: Float32Array,
    legs: Uint32Array,
  ) {
    const sum = jointWeights.reduce((a, b) => a + b, 0);
    const others = [...jointWeights.keys()].filter((joint) => jointWeights[joint]! > 0 && !legs.includes(joint));
    this.joints = [...legs, ...others];
    this.roots = this.joints.map((joint) => Math.sqrt(jointWeights[joint]! / sum));
    this.points = this.placedPoints();
    this.norms = [new Float32Array(db.frames), new Float32Array(db.frames)];
    let label = "";
    for (const clip of db.clips) {
      if (label !== `${clip.action}/${clip.style}`) this.windows.push([]);
      label = `${clip.action}/${clip.style}`;
      for (let row = clip.first_frame + WINDOW - 1; row < clip.first_frame + clip.frames; row++) {
        this.windows.at(-1)!.push(row);
        this.norms[0][row] = this.centred(this.windowEndingAt(row), this.joints.length).norm;
        this.norms[1][row] = this.centred(this.windowEndingAt(row), LEG_POINTS).norm;
      }
    }
    const { rows, stepSecs } = targets(db, style);
    this.targets = rows;
    this.stepSecs = stepSecs;
    this.sigma = standardDeviations(db);
    this.stepSigma = stepDeviations(db);
  }

  search(frames: Float32Array, fromClass: number, toClass: number): void {
    const { window, norm } = this.centred(this.pointsOf(frames), this.joints.length);
    this.nearest = this.windows.map((rows, label) => {
      const nearest: Near[] = [];
      const k = rows.length >= 4 * K ? K : Math.min(K, Math.max(Math.floor(rows.length / 4), 5));
      if (label >= fromClass && label < toClass) this.look(rows, window, norm, k, nearest);
      return nearest;
    });
  }

  /** Keeps the nearest `k` of the windows that end at these rows and of those found before. */
  private look(rows: number[], query: Float32Array, norm: number, k: number, nearest: Near[]): void {
    const length = this.joints.length * 3;
    const count = query.length / WINDOW;
    const norms = this.norms[count === length ? 0 : 1];
    const { points } = this;
    for (const row of rows) {
      let heights = 0;
      let real = 0;
      let imaginary = 0;
      for (let f = 0; f < WINDOW; f++) {
        const stored = (row + 1 - WINDOW + f) * length;
        for (let i = 0; i < count; i += 3) {
          const ax = query[f * count + i]!;
          const az = query[f * count + i + 2]!;
          const bx = points[stored + i]!;
          const bz = points[stored + i + 2]!;
          heights += query[f * count + i + 1]! * points[stored + i + 1]!;
          real += ax * bx + az * bz;
          imaginary += ax * bz - az * bx;
        }
      }
      const products = heights + Math.sqrt(real * real + imaginary * imaginary);
      const distance = Math.max(norm + norms[row]! - (2 * products) / WINDOW, 0);
      if (nearest.length === k && distance >= nearest[k - 1]!.distance) continue;
      if (nearest.length === k) nearest.pop();
      let at = nearest.length;
      while (at > 0 && nearest[at - 1]!.distance > distance) at--;
      nearest.splice(at, 0, { distance, row });
    }
  }

  contacts(frames: Float32Array): number[] {
    const points = this.pointsOf(frames);
    const { window, norm } = this.centred(points, LEG_POINTS);
    const nearest: Near[] = [];
    this.windows.forEach((rows, label) => {
      if (this.weights[label]! > 0) this.look(rows, window, norm, VOTERS, nearest);
    });
    const input = this.feet(points);
    const votes = [0, 0];
    const voices = [0, 0];
    for (const { row } of nearest) {
      const feet = this.feet(this.windowEndingAt(row));
      for (const side of [0, 1]) {
        let difference = 0;
        for (const point of [side, side + 2]) {
          difference += ((feet[point]!.height - input[point]!.height) / SAME_HEIGHT) ** 2;
          difference += ((feet[point]!.speed - input[point]!.speed) / SAME_SPEED) ** 2;
        }
        const voice = 1 / (difference + SAME);
        voices[side]! += voice;
        votes[side]! += voice * this.db.contact[2 * row + side]!;
      }
    }
    return votes.map((vote, side) => vote / voices[side]!);
  }

  /** Returns height and speed of both ankles and both toes in a window's last but one frame. */
  private feet(window: Float32Array): { height: number; speed: number }[] {
    return [0, 1, 2, 3].map((i) => {
      const at = (frame: number, axis: number) =>
        window[3 * (frame * this.joints.length + FEET + i) + axis]! / this.roots[FEET + i]!;
      const step = [0, 1, 2].map((axis) => at(WINDOW - 1, axis) - at(WINDOW - 3, axis));
      return { height: at(WINDOW - 2, 1), speed: 0.5 * Math.hypot(...step) * this.db.rateHz };
    });
  }

  /** Returns the weighted joints in frames of positions, times the roots of their weights. */
  private pointsOf(frames: Float32Array): Float32Array {
    const points = new Float32Array(WINDOW * 3 * this.joints.length);
    for (let f = 0; f < WINDOW; f++)
      this.joints.forEach((joint, i) => {
        for (let c = 0; c < 3; c++)
          points[3 * (f * this.joints.length + i) + c] = this.roots[i]! * frames[3 * (f * JOINTS + joint) + c]!;
      });
    return points;
  }

  predict(x: Float32Array, xBefore: Float32Array, yBefore: Float32Array, leastWeight: number): Float32Array {
    const { dofs, pose, rateHz } = this.db;
    const { targets } = this;
    this.weights = this.classWeights(leastWeight);
    const y = new Float32Array(dofs);
    const step = new Float32Array(dofs);
    for (let d = 0; d < dofs; d++) step[d] = RHO * (x[d]! - xBefore[d]!);
    this.nearest.forEach((nearest, label) => {
      const weight = this.weights[label]!;
      if (weight === 0) return;
      const first = nearest[0]!.distance;
      const last = nearest.at(-1)!.distance;
      const tapers = nearest.map((n) => (last > first ? (last - n.distance) / (last - first) : 1));
      const total = tapers.reduce((a, b) => a + b, 0);
      for (let d = 0; d < dofs; d++) {
        // Columns: the input in the previous and the present frame, the target in the previous and the present frame.
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
    const heaviest = this.weights.indexOf(Math.max(...this.weights));
    const known = 1 / (1 + (this.nearest[heaviest]![0]!.distance / HALF_UNKNOWN) ** 4);
    const share = 1 - 2 ** (-1 / rateHz / (HALF_LIFE_SECS * (LONGEST - (LONGEST - 1) * known)));
    for (let d = 0; d < dofs; d++) {
      const expected = yBefore[d]! + step[d]!;
      y[d] = expected + share * (y[d]! - expected);
    }
    return y;
  }

  duration(x: Float32Array, xBefore: Float32Array, y: Float32Array, yBefore: Float32Array): number {
    const { dofs, pose } = this.db;
    const parts = [
      { rows: pose, now: x, before: xBefore },
      { rows: this.targets, now: y, before: yBefore },
    ];
    let duration = 0;
    this.nearest.forEach((nearest, label) => {
      const weight = this.weights[label]!;
      if (weight === 0) return;
      const first = nearest[0]!.distance;
      const last = nearest.at(-1)!.distance;
      const squares = nearest.map(({ row }) => {
        let square = 0;
        for (const { rows, now, before } of parts)
          for (let d = 0; d < dofs; d++) {
            const pose = now[d]! - rows[row * dofs + d]!;
            const step = pose - (before[d]! - rows[(row - 1) * dofs + d]!);
            square += (pose / this.sigma[d]!) ** 2 + (step / this.stepSigma[d]!) ** 2;
          }
        return square;
      });
      const bandwidth = squares.reduce((sum, square) => sum + Math.sqrt(square), 0) / squares.length;
      const least = Math.min(...squares);
      let sum = 0;
      let total = 0;
      nearest.forEach(({ row, distance }, n) => {
        const taper = last > first ? (last - distance) / (last - first) : 1;
        const w = taper * Math.exp((0.5 * (least - squares[n]!)) / Math.max(bandwidth * bandwidth, 1e-12));
        sum += w * this.stepSecs[row]!;
        total += w;
      });
      duration += (weight * sum) / total;
    });
    return duration;
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
    const width = DELTA * (3 - 2 / (1 + (least / HALF_KNOWN) ** 4));
    const weights = distances.map((distance) => Math.exp(Math.min(least - distance, 0) / (width * least)));
    const kept = weights.map((weight) => (weight < leastWeight ? 0 : weight));
    const keptSum = kept.reduce((a, b) => a + b, 0);
    return kept.map((weight) => weight / keptSum);
  }

  /** Returns the joints of every row along its clip's path, by integration of the rows' velocities. */
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

  /** Returns a window of only the first `points`, with their centroid above the origin, and its squared length. */
  private centred(of: Float32Array, points: number): { window: Float32Array; norm: number } {
    const { joints, roots } = this;
    const window = new Float32Array(WINDOW * 3 * points);
    for (let f = 0; f < WINDOW; f++) {
      const frame = of.subarray(3 * f * joints.length, 3 * (f * joints.length + points));
      window.set(frame, 3 * f * points);
    }
    const squares = roots.slice(0, points).reduce((sum, root) => sum + root * root, 0);
    let x = 0;
    let z = 0;
    for (let p = 0; p < WINDOW * points; p++) {
      x += (roots[p % points]! * window[3 * p]!) / WINDOW / squares;
      z += (roots[p % points]! * window[3 * p + 2]!) / WINDOW / squares;
    }
    let norm = 0;
    for (let p = 0; p < WINDOW * points; p++) {
      window[3 * p]! -= roots[p % points]! * x;
      window[3 * p + 2]! -= roots[p % points]! * z;
      norm += (window[3 * p]! ** 2 + window[3 * p + 1]! ** 2 + window[3 * p + 2]! ** 2) / WINDOW;
    }
    return { window, norm };
  }
}

/**
 * Returns the target row and its duration in a style for every row: the mean of its counterparts, or the row itself
 * without any.
 */
function targets(db: Tensors, style: number): { rows: Float32Array; stepSecs: Float32Array } {
  const { pose, dofs, frames, timeStep, rateHz, clips } = db;
  const targets = pose.slice();
  const stepSecs = new Float32Array(frames).fill(1 / rateHz);
  for (const { first_frame: first, frames: count } of clips) {
    const slots = (row: number) => (row >= first && row < first + count ? counterparts(db, style, row) : []);
    for (let row = first; row < first + count; row++) {
      const rows = slots(row).filter((at) => at >= 0);
      if (rows.length === 0) continue;
      const between = (at: number, value: (row: number) => number) => {
        const i = Math.floor(at);
        return value(i) + (at - i) * (value(Math.min(i + 1, frames - 1)) - value(i));
      };
      const step = rows.reduce((sum, at) => sum + between(at, (i) => timeStep[i]!), 0) / rows.length;
      const advance = meanAdvance(slots(row - 1), slots(row), slots(row + 1)) ?? step / timeStep[row]!;
      stepSecs[row] = advance / rateHz;
      for (let d = 0; d < dofs; d++) {
        const sum = rows.reduce((sum, at) => sum + between(at, (i) => pose[i * dofs + d]!), 0);
        targets[row * dofs + d] = sum / rows.length;
      }
    }
  }
  return { rows: targets, stepSecs };
}

/** Returns the slots of a row's counterparts in a style: fractional rows, −1 in empty slots. */
function counterparts({ counterpart, counterpartsPerStyle: most, styles }: Tensors, style: number, row: number) {
  const first = (row * styles.length + style) * most;
  return [...counterpart.subarray(first, first + most)];
}

/**
 * Returns the number of rows that counterparts advance in a frame, from both sides: the mean of the continuous slots,
 * if there are any.
 */
function meanAdvance(before: number[], now: number[], after: number[]): number | undefined {
  const advance = (from = -1, to = -1) => (from >= 0 && to >= from && to < from + JUMP_ROWS ? [to - from] : []);
  const mean = (of: number[]) => of.reduce((sum, value) => sum + value, 0) / of.length;
  const slots = now
    .map((at, slot) => [...advance(before[slot], at), ...advance(at, after[slot])])
    .filter((sides) => sides.length > 0)
    .map(mean);
  return slots.length > 0 ? mean(slots) : undefined;
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

/** Returns the standard deviation of each degree of freedom's change between successive frames of a clip. */
function stepDeviations({ pose, dofs, clips }: Tensors): Float32Array {
  const rows = clips.flatMap((clip) => Array.from({ length: clip.frames - 1 }, (_, i) => clip.first_frame + 1 + i));
  const deviations = new Float32Array(dofs);
  for (let d = 0; d < dofs; d++) {
    const step = (row: number) => pose[row * dofs + d]! - pose[(row - 1) * dofs + d]!;
    const mean = rows.reduce((sum, row) => sum + step(row), 0) / rows.length;
    const variance = rows.reduce((sum, row) => sum + (step(row) - mean) ** 2, 0) / rows.length;
    deviations[d] = Math.max(Math.sqrt(variance), 1e-5);
  }
  return deviations;
}

/**
 * Solves for the weights of the regressors by Gaussian elimination. The weight of yₜ₋₁ is clamped, and the other two
 * are solved for it.
 */
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
