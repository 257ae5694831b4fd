/** Shading of a body: physically based with a coat and the room's reflections, or matt. */
export type Shading = "physical" | "matt";
