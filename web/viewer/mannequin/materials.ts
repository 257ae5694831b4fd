/** What the mannequin wears: two tones of a matt shell, and the translucent ghost. */

import {
  AlwaysStencilFunc,
  Color,
  LessEqualDepth,
  type Material,
  MeshBasicMaterial,
  MeshPhysicalMaterial,
  MeshStandardMaterial,
  NotEqualStencilFunc,
  ReplaceStencilOp,
  ShaderMaterial,
} from "three";
import type { Theme } from "../themes";

/** Stencil value of the pixels that a body covers, so that a ghost can stay behind it. */
const BODY_STENCIL = 1;

/** Materials of a solid mannequin, shared by any number of them. */
export class BodyMaterials {
  readonly shell = new MeshPhysicalMaterial({ roughness: 0.52, clearcoat: 0.18, clearcoatRoughness: 0.6 });
  readonly joint = new MeshStandardMaterial({ roughness: 0.62 });
  /** In the order of the geometry's groups. */
  readonly list: readonly [Material, Material] = [this.shell, this.joint];

  constructor() {
    for (const material of this.list) {
      material.stencilWrite = true;
      material.stencilFunc = AlwaysStencilFunc;
      material.stencilRef = BODY_STENCIL;
      material.stencilZPass = ReplaceStencilOp;
    }
  }

  /** Takes the theme's colours. */
  setTheme(theme: Theme): void {
    this.shell.color.set(theme.shell);
    this.joint.color.set(theme.joint);
  }

  dispose(): void {
    for (const material of this.list) material.dispose();
  }
}

const GHOST_VERTEX = /* glsl */ `
#include <common>
#include <skinning_pars_vertex>
varying vec3 vNormal;
varying vec3 vView;
void main() {
  #include <beginnormal_vertex>
  #include <skinbase_vertex>
  #include <skinnormal_vertex>
  #include <begin_vertex>
  #include <skinning_vertex>
  vNormal = normalMatrix * objectNormal;
  vec4 viewPosition = modelViewMatrix * vec4(transformed, 1.0);
  vView = -viewPosition.xyz;
  gl_Position = projectionMatrix * viewPosition;
}`;

// Opacity and colour rise towards the rim, where a translucent shell is thickest along the view.
const GHOST_FRAGMENT = /* glsl */ `
uniform vec3 body;
uniform vec3 rim;
uniform float opacity;
varying vec3 vNormal;
varying vec3 vView;
void main() {
  vec3 n = normalize(vNormal);
  float fresnel = pow(1.0 - max(dot(n, normalize(vView)), 0.0), 2.2);
  float light = 0.5 + 0.5 * dot(n, normalize(vec3(0.3, 0.9, 0.4)));
  gl_FragColor = vec4(mix(body * (0.55 + 0.6 * light), rim, fresnel * 0.8), opacity * (0.55 + 0.9 * fresnel));
  #include <colorspace_fragment>
}`;

/** Materials of a ghost: a depth pre-pass, so that nothing shows through itself, then the tinted shell. */
export class GhostMaterials {
  readonly depth = new MeshBasicMaterial({ colorWrite: false });
  readonly shell = new ShaderMaterial({
    vertexShader: GHOST_VERTEX,
    fragmentShader: GHOST_FRAGMENT,
    uniforms: { body: { value: new Color() }, rim: { value: new Color() }, opacity: { value: 0.4 } },
    transparent: true,
    depthWrite: false,
    depthFunc: LessEqualDepth,
  });

  constructor() {
    // Sorted with the transparent things, after every body has written its stencil.
    this.depth.transparent = true;
    for (const material of [this.depth, this.shell]) {
      material.stencilRef = BODY_STENCIL;
      material.stencilFunc = NotEqualStencilFunc;
    }
  }

  /** Whether bodies are drawn over the ghost whatever the depth, so that only the difference shows. */
  set behindBodies(behind: boolean) {
    this.depth.stencilWrite = behind;
    this.shell.stencilWrite = behind;
  }

  /** Takes the theme's colours; `fade` (0–1) scales the opacity. */
  setTheme(theme: Theme, fade = 1): void {
    const { body, rim, opacity } = this.shell.uniforms as {
      body: { value: Color };
      rim: { value: Color };
      opacity: { value: number };
    };
    body.value.set(theme.ghost.body);
    rim.value.set(theme.ghost.rim);
    opacity.value = theme.ghost.opacity * fade;
  }

  dispose(): void {
    this.depth.dispose();
    this.shell.dispose();
  }
}
