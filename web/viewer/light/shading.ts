/** How the light on a body is computed: physically with a coat and the room's reflections, or as a matt surface. */
export type Shading = "physical" | "matt";
