/** The entry for other pages: a module that defines `<strut-figure>`. */
import { defineFigure } from "./figure_element";

defineFigure();
