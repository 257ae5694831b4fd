/**
 * Trusted Types, in browsers that have them: the page's policy requires that every possible script passes through here.
 * Imported for its effect, before anything else.
 */

/** The part of the API that is used; it is not in TypeScript's library yet. */
interface TrustedTypes {
  createPolicy(name: string, rules: { createScriptURL?: (url: string) => string | null }): unknown;
}

const { trustedTypes } = globalThis as { trustedTypes?: TrustedTypes };

// Workers may only be started from files on the page's own host; no text may become a script or elements.
trustedTypes?.createPolicy("default", {
  createScriptURL: (url) => (new URL(url, location.href).origin === location.origin ? url : null),
});

export {};
