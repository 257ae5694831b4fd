/** Makes the recording of driving an input of Play. */
import { DRIVE } from "../../../../player/input_library";
import type { ViewHost } from "../../../view";
import { keepMotion } from "../kept";
import { driveWords } from "./strings.en";

/** Keeps and plays it. Returns whether there was anything to keep. */
export async function keep(host: ViewHost): Promise<boolean> {
  const driven = await host.session.driven();
  return driven !== undefined && keepMotion(host, driven, driveWords, () => void host.chooseInput(DRIVE));
}
