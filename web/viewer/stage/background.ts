/** The radial background, drawn in the scene so that a recorded video contains it. */

import { BufferAttribute, BufferGeometry, Color, Mesh, ShaderMaterial } from "three";
import type { Theme } from "../themes";

const VERTEX = /* glsl */ `
varying vec2 vUv;
void main() {
  vUv = position.xy * 0.5 + 0.5;
  gl_Position = vec4(position.xy, 1.0, 1.0);
}`;

// Mixed in display space like a CSS gradient, and dithered: eight bits show banding in a slow dark ramp.
const FRAGMENT = /* glsl */ `
uniform vec3 inner;
uniform vec3 outer;
varying vec2 vUv;
float noise(vec2 p) { return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))); }
void main() {
  vec2 fromCentre = (vUv - vec2(0.48, 0.62)) / vec2(0.75, 0.80);
  vec3 colour = mix(inner, outer, smoothstep(0.0, 1.0, length(fromCentre)));
  gl_FragColor = vec4(colour + (noise(gl_FragCoord.xy) - 0.5) / 255.0, 1.0);
}`;

/** A full-screen triangle behind everything. */
export class Background {
  readonly object: Mesh<BufferGeometry, ShaderMaterial>;

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { inner: { value: new Color() }, outer: { value: new Color() } },
      depthTest: false,
      depthWrite: false,
    });
    this.object = new Mesh(geometry, material);
    this.object.frustumCulled = false;
    this.object.renderOrder = -10;
  }

  /** Sets the theme's colours. */
  setTheme({ background }: Theme): void {
    const { inner, outer } = this.object.material.uniforms as { inner: { value: Color }; outer: { value: Color } };
    inner.value.set(background.inner).convertLinearToSRGB();
    outer.value.set(background.outer).convertLinearToSRGB();
  }

  dispose(): void {
    this.object.removeFromParent();
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}
