/** Something that a Python source declares. */
export interface Declaration {
  kind: "class" | "function" | "property" | "attribute";
  name: string;
  signature: string;
  doc: string;
  members?: Declaration[];
}
/** The declarations of a Python source or stub. */
export function declarationsOf(source: string): Declaration[];
