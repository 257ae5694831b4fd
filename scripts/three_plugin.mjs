// three.js as its modules: its published build is one file, of which a page loads all that any of its views uses.

const SHADER = /\/three\/src\/.*\.glsl\.js$/;

/** GLSL without comments and indentation, as in the published build of three.js. */
export function bareShader(glsl) {
  return glsl
    .replace(/\/\*[\s\S]*?\*\//g, "")
    .replace(/\/\/.*/g, "")
    .replace(/[ \t]*\n\s*/g, "\n")
    .trim();
}

/** Vite's plugin: what is built has those modules of three.js that it uses, with bare shaders. */
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
