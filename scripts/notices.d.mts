/** Whether an SPDX expression is one under which something may be shipped. */
export function isAllowed(expression: string): boolean;
