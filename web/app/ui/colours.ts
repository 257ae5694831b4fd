/** The colour tokens of `tokens.css` for a canvas: resolved for the current theme. */

const TOKENS = [
  "ink",
  "ink2",
  "ink3",
  "line",
  "line2",
  "track",
  "signal",
  "weight",
  "weight-edge",
  "input",
  "panel",
  "raised",
] as const;

/** A colour for each token, as CSS text. */
export type Colours = Readonly<Record<(typeof TOKENS)[number] | "contact", string>>;

/** Reads the tokens that apply within `scope`. */
export function readColours(scope: HTMLElement): Colours {
  const probe = document.createElement("span");
  probe.style.transition = "none";
  scope.append(probe);
  const resolve = (token: string) => {
    probe.style.color = `var(--${token})`;
    return getComputedStyle(probe).color;
  };
  const colours = Object.fromEntries([...TOKENS, "contact"].map((token) => [token, resolve(token)]));
  probe.remove();
  return colours as Colours;
}
