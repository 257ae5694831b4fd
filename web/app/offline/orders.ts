/** What the page tells its service worker to do: to replace the older version, or to keep all that the page may load. */
export type Order = "take over" | "keep all";
