/** Names on the ground next to the vertices of a field, readable from the camera. */

import { CanvasTexture, Group, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace } from "three";

/** Height of a line of text, metres on the ground and pixels in the texture. */
const LINE = { metres: 0.78, pixels: 96 };
/** Gap between a vertex and its name, metres. */
const GAP = 0.62;
const FONT = `600 ${0.72 * LINE.pixels}px Inter, system-ui, sans-serif`;

/** A name and its position. */
interface GroundName {
  text: string;
  x: number;
  z: number;
}

interface Drawn {
  text: string;
  x: number;
  z: number;
  width: number;
  mesh: Mesh<PlaneGeometry, MeshBasicMaterial>;
}

export class GroundNames {
  readonly object = new Group();
  #names: Drawn[] = [];
  #ink = "#ffffff";

  /** Sets the names and the colour of their text. */
  set(names: readonly GroundName[], ink: string): void {
    const same =
      ink === this.#ink &&
      names.length === this.#names.length &&
      names.every(({ text }, i) => text === this.#names[i]!.text);
    if (!same) {
      this.#clear();
      this.#ink = ink;
      this.#names = names.map((name) => this.#write(name));
    }
    for (const [i, { x, z }] of names.entries()) Object.assign(this.#names[i]!, { x, z });
  }

  /** Turns the names towards a camera at `azimuth`, radians about +Y from +Z. */
  turn(azimuth: number): void {
    const [right, forward] = [
      [Math.cos(azimuth), -Math.sin(azimuth)] as const,
      [-Math.sin(azimuth), -Math.cos(azimuth)] as const,
    ];
    for (const { mesh, x, z, width } of this.#names) {
      const along = GAP + width / 2;
      mesh.position.set(x + along * right[0] + 0.02 * forward[0], 0.004, z + along * right[1] + 0.02 * forward[1]);
      mesh.rotation.y = azimuth;
    }
  }

  dispose(): void {
    this.#clear();
    this.object.removeFromParent();
  }

  #clear(): void {
    for (const { mesh } of this.#names) {
      mesh.removeFromParent();
      mesh.geometry.dispose();
      mesh.material.map?.dispose();
      mesh.material.dispose();
    }
    this.#names = [];
  }

  #write({ text, x, z }: GroundName): Drawn {
    const canvas = document.createElement("canvas");
    const context = canvas.getContext("2d")!;
    context.font = FONT;
    canvas.width = Math.ceil(context.measureText(text).width) + 8;
    canvas.height = LINE.pixels;
    // Setting the canvas's size resets the font.
    context.font = FONT;
    context.fillStyle = this.#ink;
    context.textBaseline = "middle";
    context.fillText(text, 4, LINE.pixels / 2);
    const map = new CanvasTexture(canvas);
    map.colorSpace = SRGBColorSpace;
    map.anisotropy = 4;
    const width = (canvas.width / LINE.pixels) * LINE.metres;
    const mesh = new Mesh(
      new PlaneGeometry(width, LINE.metres).rotateX(-Math.PI / 2),
      new MeshBasicMaterial({ map, transparent: true, depthWrite: false, toneMapped: false, fog: false }),
    );
    mesh.renderOrder = -2.5;
    this.object.add(mesh);
    return { text, x, z, width, mesh };
  }
}
