import { strings } from "../strings/strings";

/** Returns a picture as a PNG file. @throws Error with a sentence for the user, if the browser cannot make one */
export async function pngOf(picture: HTMLCanvasElement): Promise<Blob> {
  const blob = await new Promise<Blob | null>((resolve) => picture.toBlob(resolve));
  if (!blob) throw new Error(strings.page.outputs.noPicture);
  return blob;
}
