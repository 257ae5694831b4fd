import type { Plugin } from "vite";

export function bareShader(glsl: string): string;
export function threePlugin(): Plugin;
