/** A declaration of a Python source. */
export interface Declaration {
  kind: "class" | "function" | "property" | "attribute";
  name: string;
  signature: string;
  doc: string;
  members?: Declaration[];
}
/** Returns the declarations of a Python source or stub. */
export function declarationsOf(source: string): Declaration[];
