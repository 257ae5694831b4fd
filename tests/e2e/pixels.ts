/** What is in a picture of a page, pixel by pixel. */
import type { Browser } from "playwright-core";

/** A colour is plain where its channels differ by this much, 0–255: white, greys and shadows do not. */
const PLAIN = 28;

/** How many pixels of a picture have a plain colour. @param picture a PNG */
export async function colouredPixels(browser: Browser, picture: Buffer): Promise<number> {
  const context = await browser.newContext();
  try {
    const page = await context.newPage();
    return await page.evaluate(
      async ({ address, plain }) => {
        const image = Object.assign(new Image(), { src: address });
        await image.decode();
        const { width, height } = image;
        const canvas = Object.assign(document.createElement("canvas"), { width, height });
        const drawing = canvas.getContext("2d")!;
        drawing.drawImage(image, 0, 0);
        const { data } = drawing.getImageData(0, 0, width, height);
        let coloured = 0;
        for (let i = 0; i < data.length; i += 4) {
          const [r, g, b] = [data[i]!, data[i + 1]!, data[i + 2]!];
          if (Math.max(r, g, b) - Math.min(r, g, b) > plain) coloured++;
        }
        return coloured;
      },
      { address: `data:image/png;base64,${picture.toString("base64")}`, plain: PLAIN },
    );
  } finally {
    await context.close();
  }
}
