/** The lessons in each language: a language is a folder, and a line here. */
import type { Language } from "../../element/figure/languages";
import * as de from "./de";
import * as en from "./en";
import type { LearnText, LessonTexts } from "./text";

/** What a language says of the lessons, and around them. */
export interface Texts {
  learn: LearnText;
  lessons: LessonTexts;
}

export const TEXTS = { en, de } as const satisfies Record<Language, Texts>;
