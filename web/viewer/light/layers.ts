/** Layers of the scene: which objects are drawn by which camera. */

/** What is drawn into the shade map; the lights must be in it too. */
export const SHADE_LAYER = 1;
/** What casts shadows, besides being in the default layer. */
export const CASTER_LAYER = 2;
