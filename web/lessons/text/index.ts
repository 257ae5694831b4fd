/** The lessons in each language: a language is a folder, and a line here. */
import type { Language } from "../../figures/languages";
import * as de from "./de";
import * as en from "./en";
import type { LearnText, LessonTexts } from "./text";

/** The texts of the lessons and around them in one language. */
export interface Texts {
  learn: LearnText;
  lessons: LessonTexts;
}

export const TEXTS = { en, de } as const satisfies Record<Language, Texts>;
