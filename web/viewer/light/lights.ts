/** The light rig: a warm area-soft key light that casts the shadow, two cool rim lights behind, a weak fill, sky and room. */

import { Color, DirectionalLight, Group, HemisphereLight, type Vector3 } from "three";
import type { Theme } from "../themes";
import { CASTER_LAYER, SHADE_LAYER } from "./layers";
import type { Shading } from "./shading";
import type { ShadowFrustum } from "./soft_shadow";

/** The key's shadow camera: wide enough for one character with raised arms and its shadow. */
export const KEY_FRUSTUM: ShadowFrustum = { depth: 9, width: 3.2 };

/** Direction to a light: degrees to the right of the camera and above the ground. */
interface Direction {
  azimuth: number;
  elevation: number;
}

const KEY: Direction = { azimuth: 34, elevation: 50 };
const RIM_LEFT: Direction = { azimuth: 215, elevation: 24 };
const RIM_RIGHT: Direction = { azimuth: 130, elevation: 20 };
const FILL: Direction = { azimuth: -45, elevation: 15 };
/** Gains that give a matt body the brightness of a physically shaded one. */
const MATT_GAIN = { key: 1.2, sky: 1.9 };
/** Distance of the lights from the followed point, metres. */
const DISTANCE = 5;
/** Height at which the rig aims, metres. */
const AIM = 0.8;

/** The lights. They follow a point on the ground and keep their position relative to the camera. */
export class Lights {
  readonly object = new Group();
  readonly #key = new DirectionalLight("#fff6ea");
  readonly #rims = [new DirectionalLight(), new DirectionalLight()] as const;
  readonly #fill = new DirectionalLight("#dfe8ff");
  readonly #sky = new HemisphereLight();

  constructor() {
    const { shadow } = this.#key;
    const half = KEY_FRUSTUM.width / 2;
    const { camera } = shadow;
    [camera.left, camera.right, camera.top, camera.bottom] = [-half, half, half, -half];
    camera.near = DISTANCE - KEY_FRUSTUM.depth / 2;
    camera.far = camera.near + KEY_FRUSTUM.depth;
    shadow.bias = -0.0008;
    shadow.normalBias = 0.012;
    shadow.radius = 1.2;
    this.#key.castShadow = true;
    const all = [this.#key, ...this.#rims, this.#fill];
    this.object.add(...all, ...all.map((light) => light.target), this.#sky);
    for (const light of [...all, this.#sky]) light.layers.enable(SHADE_LAYER);
    // The characters are in the default layer; the camera that draws the shade map is not.
    shadow.camera.layers.enable(CASTER_LAYER);
  }

  /** Side of the shadow map in texels. */
  set shadowSize(texels: number) {
    this.#key.shadow.mapSize.set(texels, texels);
  }

  /** Sets the theme's levels. With `matt` shading there are no reflections of the room; key and sky replace them. */
  setTheme({ light }: Theme, shading: Shading): void {
    const gain = shading === "matt" ? MATT_GAIN : { key: 1, sky: 1 };
    this.#key.intensity = light.key * gain.key;
    this.#rims[0].intensity = light.rim;
    this.#rims[1].intensity = light.rim * 0.5;
    for (const rim of this.#rims) rim.color.set(light.rimColour);
    this.#fill.intensity = light.fill;
    this.#sky.color.set(light.sky);
    this.#sky.groundColor.copy(new Color(light.ground));
    this.#sky.intensity = light.hemisphere * gain.sky;
  }

  /** Follows a point on the ground; `azimuth` (radians about +Y from +Z) is the direction from which the camera looks. */
  follow(point: Vector3, azimuth: number): void {
    place(this.#key, KEY, point, azimuth);
    place(this.#rims[0], RIM_LEFT, point, azimuth);
    place(this.#rims[1], RIM_RIGHT, point, azimuth);
    place(this.#fill, FILL, point, azimuth);
  }

  dispose(): void {
    this.object.removeFromParent();
    this.#key.dispose();
  }
}

/** Unit direction to the key light, for a camera at `azimuth`. */
export function keyDirection(azimuth: number, out: Vector3): Vector3 {
  const around = azimuth + (KEY.azimuth * Math.PI) / 180;
  const above = (KEY.elevation * Math.PI) / 180;
  return out.set(Math.cos(above) * Math.sin(around), Math.sin(above), Math.cos(above) * Math.cos(around));
}

function place(light: DirectionalLight, direction: Direction, point: Vector3, cameraAzimuth: number): void {
  const azimuth = cameraAzimuth + (direction.azimuth * Math.PI) / 180;
  const elevation = (direction.elevation * Math.PI) / 180;
  const ground = DISTANCE * Math.cos(elevation);
  light.target.position.set(point.x, AIM, point.z);
  light.position.set(
    point.x + ground * Math.sin(azimuth),
    AIM + DISTANCE * Math.sin(elevation),
    point.z + ground * Math.cos(azimuth),
  );
}
