/** Pictures drawn for a file, independently of the clock. */

/** Size of a picture, pixels. */
export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/**
 * Runs a task that controls all drawing: each picture has its own time, seconds from the start, and a size, by default
 * the displayed one.
 * @throws the reason with which `signal` was aborted
 */
export type Film = <T>(
  task: (pictureAt: (secs: number) => Promise<HTMLCanvasElement>) => Promise<T>,
  options?: { signal?: AbortSignal | undefined; size?: PictureSize | undefined },
) => Promise<T>;
