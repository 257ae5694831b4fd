import type { Plugin } from "vite";
export function tablesOf(markdown: string): Record<string, Record<string, number | string>[]>;
export function evaluationPlugin(): Plugin;
