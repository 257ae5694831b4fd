/** What `<strut-player>` tells, with its types: `reference.ts` has the same for documents. */
import type { LiveFrame } from "../client/protocol";

/** Detail of the event `frame`. */
export type FrameDetail = Pick<LiveFrame, "inputFrame" | "timeOut" | "planted" | "reads">;

/** The events of a player by their names. */
export interface StrutPlayerEventMap {
  /** The figure is on the screen. */
  ready: Event;
  /** Loading has come so far, 0 to 1. */
  progress: CustomEvent<{ label: string; fraction: number }>;
  /** A visitor chose styles; bubbles. */
  stylechange: CustomEvent<{ styles: Record<string, number> }>;
  /** A new frame of the motion. */
  frame: CustomEvent<FrameDetail>;
  /** It begins to play. */
  play: Event;
  /** It stands. */
  pause: Event;
  /** Something failed; what was on the stage stays. */
  error: CustomEvent<{ error: unknown }>;
}

/** An element whose listeners know what they hear. */
export type PlayerTarget = Omit<HTMLElement, "addEventListener" | "removeEventListener"> &
  Listening<"addEventListener", boolean | AddEventListenerOptions> &
  Listening<"removeEventListener", boolean | EventListenerOptions>;

type Listening<Method extends string, Options> = Record<
  Method,
  {
    <K extends keyof StrutPlayerEventMap>(
      type: K,
      listener: (event: StrutPlayerEventMap[K]) => void,
      options?: Options,
    ): void;
    <K extends Exclude<keyof HTMLElementEventMap, keyof StrutPlayerEventMap>>(
      type: K,
      listener: (event: HTMLElementEventMap[K]) => void,
      options?: Options,
    ): void;
    (type: string, listener: EventListenerOrEventListenerObject, options?: Options): void;
  }
>;
