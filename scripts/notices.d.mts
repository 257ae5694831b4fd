/** Returns whether an SPDX expression is allowed for shipped parts. */
export function isAllowed(expression: string): boolean;
