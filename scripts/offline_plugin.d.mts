import type { Plugin } from "vite";
export function writeServiceWorker(dist: string): Promise<void>;
export function offlinePlugin(): Plugin;
