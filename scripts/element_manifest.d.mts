/** Types of `element_manifest.mjs` for its tests. */
export function readTables(): Promise<unknown>;
export function attributeTableOf(tables: unknown): string;
