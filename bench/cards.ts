/** Measurements of GPUs: `gpu` of the JSON file of `npm run bench -- --gpu`, with the date. */

/** Measurements of one GPU on one database. */
export interface Card {
  adapter: string;
  driver: string;
  backend: string;
  /** Whether the GPU is emulated in software; its times are not meaningful. */
  software: boolean;
  frames: number;
  classes: number;
  /** Number of sets of neighbours, and number of those that are bit-identical to the engine's. */
  sets: number;
  identical: number;
  /** Ratio of the GPU's to the engine's search time, one window at a time and 256 together. */
  engine_is_faster?: { all: number; batch: number };
  /** Milliseconds per window on the GPU: the medians of the rows of `gpu-brute`. */
  all_ms: number;
  batch_ms: number;
  /** ISO date. */
  date: string;
}

/** Hardware GPUs only, in the order of measurement. */
export const CARDS: readonly Card[] = [
  {
    adapter: "NVIDIA H200",
    driver: "NVIDIA 580.159.04",
    backend: "Vulkan",
    software: false,
    frames: 79_829,
    classes: 48,
    sets: 83_328,
    identical: 83_328,
    engine_is_faster: { all: 2.465, batch: 0.358 },
    all_ms: 2.502,
    batch_ms: 0.363,
    date: "2026-11-26",
  },
  {
    adapter: "NVIDIA H200",
    driver: "Chromium 156, NVIDIA 580.159.04",
    backend: "WebGPU",
    software: false,
    frames: 79_829,
    classes: 48,
    sets: 49_152,
    identical: 49_152,
    engine_is_faster: { all: 2.593, batch: 0.269 },
    all_ms: 3.5,
    batch_ms: 0.363,
    date: "2026-11-26",
  },
];
