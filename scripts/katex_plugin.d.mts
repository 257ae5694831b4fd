import type { Plugin } from "vite";
export function renderEquation(tex: string): string;
export function trimmedSheet(css: string): string;
export function katexPlugin(): Plugin;
