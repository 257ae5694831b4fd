/** The walk that a page shows until the engine is there. */
export { FirstSteps } from "../engine/first_steps";
