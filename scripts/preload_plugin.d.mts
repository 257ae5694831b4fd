import type { Plugin } from "vite";

export declare function preloadPlugin(page: string, what: { modules: readonly string[]; font: string }): Plugin;
