/** The lessons in English. */
import type { LessonTexts } from "../text";

export { learn } from "./learn";

export const lessons: LessonTexts = {
  style: async () => (await import("./style")).style,
  pose: async () => (await import("./pose")).pose,
  register: async () => (await import("./register")).register,
  near: async () => (await import("./near")).near,
  line: async () => (await import("./line")).line,
  mix: async () => (await import("./mix")).mix,
  bias: async () => (await import("./bias")).bias,
  time: async () => (await import("./time")).time,
  feet: async () => (await import("./feet")).feet,
  judge: async () => (await import("./judge")).judge,
  chain: async () => (await import("./chain")).chain,
  map: async () => (await import("./map")).map,
};
