/**
 * All texts of the page in one table. English is complete; another language is a second table of the type {@link
 * Strings}, in modules like those of `en/`, and a selection here.
 */

import type { Translated } from "../../ui/translated";
import { embed } from "../embed/strings.en";
import { page } from "../shell/strings.en";
import { compare } from "../views/compare/strings.en";
import { crowd } from "../views/crowd/strings.en";
import { data } from "../views/data/strings.en";
import { keyStyle } from "../views/key_style/strings.en";
import { play } from "../views/play/strings.en";
import { synthesis } from "../views/synthesis/strings.en";
import { walk } from "../views/walk/strings.en";

const en = { embed, page, play, compare, data, walk, keyStyle, crowd, synthesis };

/** The table of a language. */
type Strings = Translated<typeof en>;

/** The current language. */
export const strings: Strings = en;
