/** Commands of the page to its service worker: to replace the older version, or to store all files that the page may load. */
export type Order = "take over" | "keep all";
