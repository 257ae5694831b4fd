import type { Manifest } from "vite";
export function siteFiles(dist: string): { manifest: Manifest; first: string[]; rest: string[] };
