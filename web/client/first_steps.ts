/** The walk that a page shows until the engine is loaded. */
export { FirstSteps } from "../engine/first_steps";
