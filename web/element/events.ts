/** Events of `<strut-player>` with their types; `reference.ts` has the same for documentation. */
import type { LiveFrame } from "../client/protocol";

/** Detail of the event `frame`. */
export type FrameDetail = Pick<LiveFrame, "inputFrame" | "timeOut" | "planted" | "reads">;

/** The events of a player by their names. */
export interface StrutPlayerEventMap {
  /** The character is displayed. */
  ready: Event;
  /** Progress of loading, 0 to 1. */
  progress: CustomEvent<{ label: string; fraction: number }>;
  /** A visitor changed the styles; bubbles. */
  stylechange: CustomEvent<{ styles: Record<string, number> }>;
  /** A new frame of the motion. */
  frame: CustomEvent<FrameDetail>;
  /** Playback started. */
  play: Event;
  /** Playback was paused. */
  pause: Event;
  /** An operation failed; the displayed character stays. */
  error: CustomEvent<{ error: unknown }>;
}

/** An element with typed event listeners. */
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
