/** Materials of the mannequin: two tones of a matt shell, and the translucent ghost. */

import {
  AlwaysStencilFunc,
  BackSide,
  Color,
  LessEqualDepth,
  type Material,
  MeshBasicMaterial,
  MeshDepthMaterial,
  MeshLambertMaterial,
  MeshPhysicalMaterial,
  MeshStandardMaterial,
  NotEqualStencilFunc,
  ReplaceStencilOp,
  ShaderMaterial,
} from "three";
import type { Role } from "../../humanoid";
import { KEY_FRUSTUM } from "../light/lights";
import type { Shading } from "../light/shading";
import { type ShadowTaps, setShadowTaps, useSoftShadow } from "../light/soft_shadow";
import type { Theme } from "../themes";
import { noTint, slotsOf, useTint } from "./part_tint";
import { SLOT_SHADER, type SlotUniforms, useSlots } from "./slot_skinning";

/** Stencil value of the pixels that a body covers, which keeps a ghost behind it. */
const BODY_STENCIL = 1;

/** One drawing of the mannequin's mesh. */
interface Layer {
  /** One material for the whole body, or one per tone (shell, joints). */
  material: Material | Material[];
  /** three.js render order. */
  order: number;
  /** Draws the mesh into shadow maps. Without it the layer casts no shadow. */
  shadow?: Material;
  receivesShadow: boolean;
}

/** The look of one mannequin: its layers, in the theme's colours. */
export interface Look {
  readonly layers: readonly Layer[];
  setTheme(theme: Theme): void;
  dispose(): void;
}

/** Share of their colour with which matt joints glow; it replaces the sheen that lifts dark plastic. */
const MATT_SHEEN = 0.22;

/** A solid mannequin. */
export class BodyLook implements Look {
  readonly #uniforms: SlotUniforms;
  // three.js draws the back faces of front-sided materials into shadow maps. Setting the side beforehand avoids
  // compiling the material twice.
  readonly #shadow = new MeshDepthMaterial({ side: BackSide });
  readonly #tint = noTint();
  readonly #tones = new Map<Shading, [shell: LitMaterial, joint: LitMaterial]>();
  #shading: Shading;
  #taps: ShadowTaps = { search: 8, filter: 8 };
  #theme: Theme | undefined;

  constructor(uniforms: SlotUniforms, shading: Shading) {
    this.#uniforms = uniforms;
    this.#shading = shading;
    useSlots(this.#shadow, uniforms);
  }

  get layers(): readonly Layer[] {
    // The few samples that a slow renderer can afford would be visible as grain.
    const receivesShadow = this.#shading === "physical";
    return [{ material: this.#present(), order: 0, shadow: this.#shadow, receivesShadow }];
  }

  /** Sets the theme's colours. */
  setTheme(theme: Theme): void {
    this.#theme = theme;
    this.#tint.tint.value.set(theme.signal);
    this.#present();
  }

  /** The joints whose parts are tinted. */
  set tinted(joints: readonly Role[]) {
    this.#tint.tintedSlots.value = slotsOf(joints);
  }

  /** Sets the shading and the samples of the self-shadow; changes {@link layers}. */
  setQuality(shading: Shading, taps: ShadowTaps): void {
    this.#shading = shading;
    this.#taps = taps;
    this.#present();
  }

  dispose(): void {
    this.#shadow.dispose();
    for (const material of [...this.#tones.values()].flat()) material.dispose();
  }

  /** The up-to-date materials of the current shading; made on first use, since compiling them is slow. */
  #present(): LitMaterial[] {
    let tones = this.#tones.get(this.#shading);
    if (!tones) {
      tones =
        this.#shading === "physical"
          ? [
              new MeshPhysicalMaterial({ roughness: 0.52, clearcoat: 0.18, clearcoatRoughness: 0.6 }),
              new MeshStandardMaterial({ roughness: 0.62 }),
            ]
          : [new MeshLambertMaterial(), new MeshLambertMaterial({ emissiveIntensity: MATT_SHEEN })];
      for (const material of tones) {
        material.stencilWrite = true;
        material.stencilFunc = AlwaysStencilFunc;
        material.stencilRef = BODY_STENCIL;
        material.stencilZPass = ReplaceStencilOp;
        useSoftShadow(material, KEY_FRUSTUM);
        useTint(material, this.#tint);
        useSlots(material, this.#uniforms);
      }
      this.#tones.set(this.#shading, tones);
    }
    for (const material of tones) setShadowTaps(material, this.#taps);
    if (this.#theme) {
      tones[0].color.set(this.#theme.shell);
      tones[1].color.set(this.#theme.joint);
      if (this.#shading === "matt") tones[1].emissive.set(this.#theme.joint);
    }
    return tones;
  }
}

type LitMaterial = MeshStandardMaterial | MeshLambertMaterial;

const GHOST_VERTEX = /* glsl */ `
${SLOT_SHADER}
varying vec3 vNormal;
varying vec3 vView;
void main() {
  vec4 view = viewMatrix * vec4(slotPoint(position), 1.0);
  vNormal = mat3(viewMatrix) * slotDirection(normal);
  vView = -view.xyz;
  gl_Position = projectionMatrix * view;
}`;

// Opacity and colour rise towards the rim, where a translucent shell is thickest along the view.
const GHOST_FRAGMENT = /* glsl */ `
uniform vec3 body;
uniform vec3 rim;
uniform float opacity;
uniform float fade;
varying vec3 vNormal;
varying vec3 vView;
void main() {
  vec3 n = normalize(vNormal);
  float fresnel = pow(1.0 - max(dot(n, normalize(vView)), 0.0), 2.2);
  float light = 0.5 + 0.5 * dot(n, normalize(vec3(0.3, 0.9, 0.4)));
  gl_FragColor = vec4(mix(body * (0.55 + 0.6 * light), rim, fresnel * 0.8), fade * opacity * (0.55 + 0.9 * fresnel));
  #include <colorspace_fragment>
}`;

/** A ghost: a depth pre-pass, so that its own back faces do not show through, then the tinted shell. */
export class GhostLook implements Look {
  readonly layers: readonly Layer[];
  readonly #depth = new MeshBasicMaterial({ colorWrite: false, transparent: true });
  readonly #shell: ShaderMaterial;
  readonly #tint = {
    body: { value: new Color() },
    rim: { value: new Color() },
    opacity: { value: 0 },
    fade: { value: 1 },
  };

  constructor(uniforms: SlotUniforms) {
    useSlots(this.#depth, uniforms);
    this.#shell = new ShaderMaterial({
      vertexShader: GHOST_VERTEX,
      fragmentShader: GHOST_FRAGMENT,
      uniforms: { ...uniforms, ...this.#tint },
      transparent: true,
      depthWrite: false,
      depthFunc: LessEqualDepth,
    });
    for (const material of [this.#depth, this.#shell]) {
      material.stencilRef = BODY_STENCIL;
      material.stencilFunc = NotEqualStencilFunc;
    }
    this.layers = [
      { material: this.#depth, order: 2, receivesShadow: false },
      { material: this.#shell, order: 3, receivesShadow: false },
    ];
  }

  /** Whether bodies are drawn over the ghost regardless of depth, so that only the difference is visible. */
  set behindBodies(behind: boolean) {
    this.#depth.stencilWrite = behind;
    this.#shell.stencilWrite = behind;
  }

  /** Factor on the opacity, 0–1. */
  set fade(fade: number) {
    this.#tint.fade.value = fade;
  }

  /** Sets the theme's colours. */
  setTheme({ ghost }: Theme): void {
    this.#tint.body.value.set(ghost.body);
    this.#tint.rim.value.set(ghost.rim);
    this.#tint.opacity.value = ghost.opacity;
  }

  dispose(): void {
    this.#depth.dispose();
    this.#shell.dispose();
  }
}
