/**
 * Trusted Types, where a browser has them: the page's policy demands that whatever may run as a script passes through here.
 * Imported for its effect, before anything else.
 */

/** The part of the API that is used; TypeScript's library does not have it yet. */
interface TrustedTypes {
  createPolicy(name: string, rules: { createScriptURL?: (url: string) => string | null }): unknown;
}

const { trustedTypes } = globalThis as { trustedTypes?: TrustedTypes };

// Workers are started from files of the page's own host, and from nothing else; no text becomes a script or elements.
trustedTypes?.createPolicy("default", {
  createScriptURL: (url) => (new URL(url, location.href).origin === location.origin ? url : null),
});

export {};
