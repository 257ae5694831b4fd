/** The part of Khronos' glTF validator that the tests use; the package has no types. */
declare module "gltf-validator" {
  /** A finding; `severity` is 0 for an error, 1 for a warning, 2 and 3 for information. */
  export interface Message {
    code: string;
    message: string;
    severity: 0 | 1 | 2 | 3;
    pointer?: string;
  }

  export interface Report {
    issues: { numErrors: number; numWarnings: number; messages: Message[] };
  }

  /** Validates a glTF or GLB file. */
  export function validateBytes(bytes: Uint8Array): Promise<Report>;
}
