/**
 * Area-soft shadows: percentage-closer soft shadows (Fernando, "Percentage-Closer Soft Shadows", 2005) instead of
 * three.js's filter. The penumbra widens with the distance between caster and receiver, so that a planted foot has a
 * crisp shadow and the head a soft one. Needs `BasicShadowMap`, whose depths can be read without comparison.
 */

import type { Material, WebGLProgramParametersWithUniforms } from "three";

/** Tangent of the light's angular radius as seen from the ground. */
const LIGHT_TANGENT = 0.11;

/** Depth range and width of the light's frustum, metres: converts depth differences to penumbra widths. */
export interface ShadowFrustum {
  depth: number;
  width: number;
}

function shader({ depth, width }: ShadowFrustum): string {
  return /* glsl */ `
#define SLOPE_LIMIT ${((2 * width) / depth).toFixed(6)}
#if defined(USE_SHADOWMAP) && NUM_DIR_LIGHT_SHADOWS > 0
  float shadowNoise(vec2 p) { return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))); }

  // Points of a Vogel disk: even in area, no rings.
  vec2 shadowDisk(int i, int count, float turn) {
    float angle = float(i) * 2.399963229728653 + turn;
    return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
  }

  // Change of the receiver's depth with its place in the map, from its neighbours on screen: without it, a wide filter
  // would find the receiver's own slope in its way. Bounded, because neighbours may lie on another part.
  vec2 receiverSlope(vec3 receiver) {
    vec3 dx = dFdx(receiver);
    vec3 dy = dFdy(receiver);
    float area = dx.x * dy.y - dx.y * dy.x;
    if (abs(area) < 1e-12) return vec2(0.0);
    vec2 slope = vec2(dy.y * dx.z - dx.y * dy.z, dx.x * dy.z - dy.x * dx.z) / area;
    return clamp(slope, vec2(-SLOPE_LIMIT), vec2(SLOPE_LIMIT));
  }

  float softShadow(sampler2D map, vec2 size, float intensity, float bias, float radius, vec4 coord) {
    vec3 receiver = coord.xyz / coord.w;
    receiver.z += bias;
    vec2 slope = receiverSlope(receiver);
    if (any(lessThan(receiver.xy, vec2(0.0))) || any(greaterThan(receiver.xy, vec2(1.0))) || receiver.z > 1.0) return 1.0;
    // A full turn would trade the disk's bands for grain; half the angle between samples only dissolves them, and with few
    // samples even that is grain.
    float turn = SHADOW_TAPS < 20 ? 0.0 : shadowNoise(gl_FragCoord.xy) * (3.141592653589793 / float(SHADOW_TAPS));
    const float spread = ${(LIGHT_TANGENT * (depth / width)).toFixed(6)};
    float search = min(spread * receiver.z, ${(0.3 / width).toFixed(6)});
    float blockers = 0.0;
    float depthSum = 0.0;
    for (int i = 0; i < SHADOW_SEARCH_TAPS; i++) {
      vec2 offset = shadowDisk(i, SHADOW_SEARCH_TAPS, turn) * search;
      float d = texture2D(map, receiver.xy + offset).r;
      if (d < receiver.z + dot(offset, slope)) {
        blockers += 1.0;
        depthSum += d;
      }
    }
    if (blockers == 0.0) return 1.0;
    float penumbra = max(spread * (receiver.z - depthSum / blockers), radius / size.x);
    float lit = 0.0;
    for (int i = 0; i < SHADOW_TAPS; i++) {
      vec2 offset = shadowDisk(i, SHADOW_TAPS, turn) * penumbra;
      lit += step(receiver.z + dot(offset, slope), texture2D(map, receiver.xy + offset).r);
    }
    return mix(1.0, lit / float(SHADOW_TAPS), intensity);
  }
  #define getShadow softShadow
#endif`;
}

/** Samples of one shadow look-up. */
export interface ShadowTaps {
  search: number;
  filter: number;
}

/** Makes a lit material use soft shadows; `also` can edit its shader further. */
export function useSoftShadow(
  material: Material,
  frustum: ShadowFrustum,
  also?: (parameters: WebGLProgramParametersWithUniforms) => void,
): void {
  const source = shader(frustum);
  material.onBeforeCompile = (parameters) => {
    parameters.fragmentShader = parameters.fragmentShader.replace(
      "#include <shadowmap_pars_fragment>",
      `#include <shadowmap_pars_fragment>\n${source}`,
    );
    also?.(parameters);
  };
}

/** Sets the number of samples; recompiles only if it changed. */
export function setShadowTaps(material: Material, { search, filter }: ShadowTaps): void {
  if (material.defines?.SHADOW_TAPS === filter && material.defines.SHADOW_SEARCH_TAPS === search) return;
  material.defines = { ...material.defines, SHADOW_SEARCH_TAPS: search, SHADOW_TAPS: filter };
  material.needsUpdate = true;
}
