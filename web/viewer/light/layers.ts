/** Layers of the scene: which camera draws which objects. */

/** Objects drawn into the shade map; the lights must be in it too. */
export const SHADE_LAYER = 1;
/** Objects that cast shadows, in addition to the default layer. */
export const CASTER_LAYER = 2;
