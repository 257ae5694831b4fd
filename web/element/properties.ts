/** Properties of an element that reflect its attributes. */
import { ATTRIBUTE_NAMES, propertyOf, readAttribute, writeProperty } from "./attributes";

/** Defines the properties that a class of elements does not define itself. */
export function defineProperties(prototype: HTMLElement): void {
  for (const name of ATTRIBUTE_NAMES) {
    const property = propertyOf(name);
    if (Object.hasOwn(prototype, property)) continue;
    Object.defineProperty(prototype, property, {
      configurable: true,
      enumerable: true,
      get(this: HTMLElement) {
        return readAttribute(this, name);
      },
      set(this: HTMLElement, value: unknown) {
        writeProperty(this, name, value);
      },
    });
  }
}

/** Applies properties that were set before the element was defined; they hide those of its class. */
export function takeEarlyProperties(element: HTMLElement, others: readonly string[]): void {
  for (const name of [...ATTRIBUTE_NAMES.map(propertyOf), ...others]) {
    if (!Object.hasOwn(element, name)) continue;
    const value: unknown = Reflect.get(element, name);
    Reflect.deleteProperty(element, name);
    Reflect.set(element, name, value);
  }
}
