/** The name of the renderer in few words: browsers wrap the GPU's name in those of their translation layers. */
export function rendererName(drawnBy: string): string {
  if (/swiftshader/i.test(drawnBy)) return "SwiftShader";
  // ANGLE (vendor, renderer, driver)
  const [, renderer = drawnBy] = /^ANGLE \([^,]*, (.*), [^,]*\)$/.exec(drawnBy) ?? [];
  return renderer
    .replace(/^ANGLE \w+ Renderer: /, "")
    .replace(/^Vulkan [\d.]+ \((.*)\)$/, "$1")
    .replace(/ Direct3D.*$/, "")
    .replace(/^(\w+ )\1/, "$1")
    .replace(/ ?\(0x[\da-f]+\)/gi, "")
    .replace(/\/PCIe\/SSE2$/, "")
    .trim();
}
