// Uses the modules of three.js: its published build is one file, of which a page would load everything that any of its
// views uses.

const SHADER = /\/three\/src\/.*\.glsl\.js$/;

/** Returns GLSL without comments and indentation, as in the published build of three.js. */
export function bareShader(glsl) {
  return glsl
    .replace(/\/\*[\s\S]*?\*\//g, "")
    .replace(/\/\/.*/g, "")
    .replace(/[ \t]*\n\s*/g, "\n")
    .trim();
}

/** Vite's plugin: a build contains only the modules of three.js that it uses, with minified shaders. */
export function threePlugin() {
  return {
    name: "strut-three",
    apply: "build",
    config: () => ({ resolve: { alias: [{ find: /^three$/, replacement: "three/src/Three.js" }] } }),
    transform(code, id) {
      if (!SHADER.test(id)) return null;
      return { code: code.replace(/\/\* glsl \*\/`([^`]*)`/g, (_, glsl) => `\`${bareShader(glsl)}\``), map: null };
    },
  };
}
