/**
 * The table of another language: a text where the original has one, and a function with the same parameters where it has
 * a function. The original is a constant, so that its lists have lengths.
 */
export type Translated<T> = T extends string
  ? string
  : T extends (...parts: infer P) => string
    ? (...parts: P) => string
    : { readonly [K in keyof T]: Translated<T[K]> };
