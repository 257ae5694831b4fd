/** Analysis of a page's picture, pixel by pixel. */
import type { Browser } from "playwright-core";

/** A pixel is coloured if its channels differ by this much, 0–255: white, greys and shadows are not. */
const PLAIN = 28;

/** A part of a picture, as shares of its width and height. */
export interface Part {
  x: number;
  y: number;
  width: number;
  height: number;
}

const ALL: Part = { x: 0, y: 0, width: 1, height: 1 };

/** Returns the number of coloured pixels in a picture, or in a part of it. @param picture a PNG */
export async function colouredPixels(browser: Browser, picture: Buffer, part = ALL): Promise<number> {
  const context = await browser.newContext();
  try {
    const page = await context.newPage();
    return await page.evaluate(
      async ({ address, plain, part }) => {
        const image = Object.assign(new Image(), { src: address });
        await image.decode();
        const { width, height } = image;
        const canvas = Object.assign(document.createElement("canvas"), { width, height });
        const drawing = canvas.getContext("2d")!;
        drawing.drawImage(image, 0, 0);
        const { data } = drawing.getImageData(
          Math.round(part.x * width),
          Math.round(part.y * height),
          Math.round(part.width * width),
          Math.round(part.height * height),
        );
        let coloured = 0;
        for (let i = 0; i < data.length; i += 4) {
          const [r, g, b] = [data[i]!, data[i + 1]!, data[i + 2]!];
          if (Math.max(r, g, b) - Math.min(r, g, b) > plain) coloured++;
        }
        return coloured;
      },
      { address: `data:image/png;base64,${picture.toString("base64")}`, plain: PLAIN, part },
    );
  } finally {
    await context.close();
  }
}
