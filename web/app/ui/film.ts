/** Pictures that are drawn for a file, off the clock. */

/** Size of a picture, pixels. */
export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/**
 * Runs a task while pictures are drawn for it alone, each at its own time, seconds from the start, and at a size, or as they are
 * on screen.
 * @throws what `signal` was aborted with
 */
export type Film = <T>(
  task: (pictureAt: (secs: number) => Promise<HTMLCanvasElement>) => Promise<T>,
  options?: { signal?: AbortSignal | undefined; size?: PictureSize | undefined },
) => Promise<T>;
