/** A picture as a PNG file; `undefined` if the browser cannot make one. */
export function pngOf(picture: HTMLCanvasElement): Promise<Blob | undefined> {
  return new Promise((resolve) => picture.toBlob((blob) => resolve(blob ?? undefined)));
}
