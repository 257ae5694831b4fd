/** `window.strut`: what is on screen, read-only, for embedding pages, scripts and the end-to-end tests. */
import type { Role } from "../viewer";
import type { LiveFrame } from "../worker/protocol";
import type { PlayState } from "./state";

export interface StrutHook {
  /** The newest frame of the engine; `undefined` until the first. */
  readonly frame: LiveFrame | undefined;
  /** The state, as the URL has it. */
  readonly state: Readonly<PlayState>;
  /** Whether the pose on screen is in the present style and at the present place; only while paused does it stay so. */
  readonly upToDate: boolean;
  /** Whether the timeline shows the present style. */
  readonly analysed: boolean;
  /** Place of a joint of the styled character in the page, CSS pixels. */
  jointScreenPosition(role: Role): { x: number; y: number };
}

declare global {
  interface Window {
    /** Present once the page runs. */
    strut?: StrutHook;
  }
}
