/** Builds elements in one expression, with helpers for the document that several modules need. */

export type Attributes = Readonly<Record<string, string | number | boolean>>;

const SVG = "http://www.w3.org/2000/svg";

/**
 * Sets attributes if they differ, so that unchanged ones cause no layout; `true` is an empty attribute, `false` removes
 * it. `style` is CSS text and set through the object model, because the page's content security policy forbids style
 * attributes.
 */
export function setAttributes(target: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "style" && typeof value === "string") (target as HTMLElement | SVGElement).style.cssText = value;
    else if (value === false) target.removeAttribute(name);
    else {
      const text = value === true ? "" : String(value);
      if (target.getAttribute(name) !== text) target.setAttribute(name, text);
    }
  }
}

/** An HTML element with attributes and children. */
export function html<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  setAttributes(made, attributes);
  made.append(...children);
  return made;
}

/** An SVG element with attributes and children. */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): SVGElementTagNameMap[K] {
  const made = document.createElementNS(SVG, tag);
  setAttributes(made, attributes);
  made.append(...children);
  return made;
}

/** Sets text only if it differs, so that an unchanged readout causes no layout. */
export function setText(target: Element, text: string): void {
  if (target.textContent !== text) target.textContent = text;
}

/** Saves a file as a download. */
export function saveFile(name: string, file: Blob): void {
  const url = URL.createObjectURL(file);
  html("a", { href: url, download: name }).click();
  // The browser has the data after the click.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** A number with a real minus sign and fixed decimals. */
export function formatNumber(value: number, digits: number): string {
  return value
    .toFixed(digits)
    .replace(/^-(?=0(\.0*)?$)/, "")
    .replace("-", "−");
}

/** Seconds as 02.67, minutes as 1:02.67. */
export function clock(seconds: number): string {
  const minutes = Math.floor(seconds / 60);
  const rest = formatNumber(seconds - 60 * minutes, 2).padStart(5, "0");
  return minutes > 0 ? `${minutes}:${rest}` : rest;
}

/** Adjusts a group to `count` children: missing ones are created, and excess ones removed from the end. */
export function keepCount(group: Element, count: number, create: () => Element): void {
  while (group.childElementCount > count) group.lastElementChild!.remove();
  while (group.childElementCount < count) group.append(create());
}
