/** `window.strut`: the displayed state, read-only, for embedding pages, scripts and the end-to-end tests. */

import type { LiveFrame } from "../../client/protocol";
import type { Role } from "../../humanoid";
import type { AppState } from "../state/state";

export interface StrutHook {
  /** The newest frame of the engine; `undefined` until the first. */
  readonly frame: LiveFrame | undefined;
  /** The state that the URL encodes. */
  readonly state: Readonly<AppState>;
  /** Whether the displayed pose has the current input, style and frame. It changes all the time unless the motion is paused. */
  readonly upToDate: boolean;
  /** Whether the analysis in the timeline has the current style. */
  readonly analysed: boolean;
  /** Position of a joint of the styled character in the page, CSS pixels. */
  jointScreenPosition(role: Role): { x: number; y: number };
  /** Position of a point on the ground, metres, in the page, CSS pixels. */
  groundScreenPosition(x: number, z: number): { x: number; y: number };
}

declare global {
  interface Window {
    /** Defined once the app is built. */
    strut?: StrutHook;
  }
}
