/** Options of the engine: their ranges, and checks against a database. */
import { StrutError } from "../engine/errors";
import { plain } from "./plain";
import {
  BODY_PARTS,
  type DatabaseInfo,
  DEFAULT_OPTIONS,
  METHODS,
  type StyleWeights,
  type StylizeOptions,
  TRAINED_METHODS,
} from "./protocol";

/** Inclusive ranges of the numbers: `rust/strut-core/src/transfer/options.rs`. */
export const OPTION_RANGES = {
  k: [1, 1000],
  lambda: [1e-4, 1e4],
  rho: [0, 1],
  kappa: [0, Number.POSITIVE_INFINITY],
  delta: [0.01, 100],
  tempo: [0, 1],
} as const satisfies Partial<Record<keyof StylizeOptions, readonly [number, number]>>;

/**
 * Applies changes to options.
 * @throws StrutError `bad-input` for an unknown option, a number outside its range, or a name that the database lacks
 */
export function changedOptions(
  database: DatabaseInfo,
  present: StylizeOptions,
  change: Partial<StylizeOptions>,
): StylizeOptions {
  const unknown = Object.keys(change).find((name) => !Object.hasOwn(DEFAULT_OPTIONS, name));
  if (unknown !== undefined) throw refusal(`There is no option '${unknown}'`, Object.keys(DEFAULT_OPTIONS));
  // A copy: later changes of the caller's object have no effect.
  const options = plain({ ...present, ...change });
  for (const [name, [min, max]] of Object.entries(OPTION_RANGES)) {
    const value = options[name as keyof typeof OPTION_RANGES];
    if (!(value >= min && value <= max)) throw refusal(`${name} is ${value}; ${min} to ${max} was expected`, []);
  }
  const methods: readonly string[] = [...METHODS, ...TRAINED_METHODS];
  if (!methods.includes(options.method)) throw refusal(`There is no method '${options.method}'`, methods);
  const part = Object.keys(options.parts).find((name) => !BODY_PARTS.some((known) => known === name));
  if (part !== undefined) throw refusal(`There is no body part '${part}'`, BODY_PARTS);
  for (const weights of weightsIn(options))
    for (const [style, weight] of Object.entries(weights)) {
      if (!database.styles.includes(style)) throw refusal(`The database has no style '${style}'`, database.styles);
      if (!Number.isFinite(weight)) throw refusal(`The weight of '${style}' is ${weight}; a number was expected`, []);
    }
  if (!hasClass(database, options)) {
    const { action, inputStyle } = options;
    throw refusal(`The database has no class of action '${action}' and style '${inputStyle}'`, []);
  }
  return options;
}

/** Options without the styles and labels that a database lacks; the same object if it has all of them. */
export function optionsKnownTo(database: DatabaseInfo, options: StylizeOptions): StylizeOptions {
  const { styles } = database;
  const labelled = hasClass(database, options);
  const isKnown = (name: string) => styles.includes(name);
  if (labelled && weightsIn(options).every((weights) => Object.keys(weights).every(isKnown))) return options;
  const known = (weights: StyleWeights) =>
    Object.fromEntries(Object.entries(weights).filter(([name]) => isKnown(name)));
  return {
    ...options,
    ...(labelled ? {} : { action: "", inputStyle: "" }),
    styles: known(options.styles),
    parts: Object.fromEntries(Object.entries(options.parts).map(([part, weights]) => [part, known(weights)])),
    track: options.track.map(({ frame, styles }) => ({ frame, styles: known(styles) })),
  };
}

/** All weights in the options. */
function weightsIn({ styles, parts, track }: StylizeOptions): StyleWeights[] {
  return [styles, ...Object.values(parts), ...track.map((key) => key.styles)];
}

/** Whether a database has frames of the action and style that are set for the input. */
function hasClass({ classes }: DatabaseInfo, { action, inputStyle }: StylizeOptions): boolean {
  return classes.some((c) => (!action || action === c.action) && (!inputStyle || inputStyle === c.style));
}

function refusal(what: string, known: readonly string[]): StrutError {
  const hint = known.length > 0 ? `There are ${known.join(", ")}.` : "";
  return new StrutError({ code: "bad-input", message: `${what}.`, hint });
}
