/** Permissions by the author of a model (`shared/spec/embedding.md` section 5.8). */
import { type GltfJson, isRecord, vrmOf } from "./vrm_humanoid";

/** Terms of use in a model's file. */
export interface Licence {
  /** Name of the model. */
  readonly title: string;
  /** Names of its authors. */
  readonly authors: readonly string[];
  /** URL of the terms. */
  readonly url?: string;
  /** Whether the author must be named. */
  readonly credit: boolean;
  /** Whether everyone may perform the character. */
  readonly everybody: boolean;
  /** Whether the model may be redistributed with another motion in it. */
  readonly mayExport: boolean;
}

/**
 * The licence in a glTF document: VRM's meta, otherwise the copyright notice; `undefined` if it has neither. Fields
 * that a VRM omits have the default of its specification, and an unknown value counts as the strictest.
 */
export function licenceOf(json: GltfJson): Licence | undefined {
  const vrm = vrmOf(json);
  const { meta } = vrm?.extension ?? {};
  if (vrm && isRecord(meta)) return vrm.version === 1 ? ofVrm1(meta) : ofVrm0(meta);
  const copyright = text(json.asset?.copyright);
  if (vrm) return { title: "", authors: [], credit: true, everybody: false, mayExport: false };
  if (!copyright) return undefined;
  const mayExport = !/no[\s-]*derivati|(^|[^a-z])nd([^a-z]|$)|all rights reserved/i.test(copyright);
  return { title: copyright, authors: [], credit: true, everybody: true, mayExport };
}

/** VRM 1.0, `VRMC_vrm.meta`. Without `avatarPermission` only the author performs; without `modification` it is prohibited. */
function ofVrm1(meta: Record<string, unknown>): Licence {
  const { avatarPermission, modification, allowRedistribution, creditNotation } = meta;
  const url = address(meta.otherLicenseUrl) ?? address(meta.licenseUrl);
  // Modified files may be redistributed under one value only; the other one allows private use.
  const mayExport = modification === "allowModificationRedistribution" && allowRedistribution === true;
  return {
    title: text(meta.name),
    authors: Array.isArray(meta.authors) ? meta.authors.map(text).filter(Boolean) : [],
    ...(url ? { url } : {}),
    credit: creditNotation !== "unnecessary",
    everybody: avatarPermission === "everyone",
    mayExport,
  };
}

/** Licences of VRM 0 that allow redistribution of modified files. */
const MODIFIABLE = ["CC0", "CC_BY", "CC_BY_NC", "CC_BY_SA", "CC_BY_NC_SA"];

/** VRM 0.x, `VRM.meta`. */
function ofVrm0(meta: Record<string, unknown>): Licence {
  const { allowedUserName, licenseName } = meta;
  const url = address(meta.otherLicenseUrl) ?? address(meta.otherPermissionUrl);
  return {
    title: text(meta.title),
    authors: [text(meta.author)].filter(Boolean),
    ...(url ? { url } : {}),
    credit: licenseName !== "CC0",
    everybody: allowedUserName === "Everyone",
    mayExport: MODIFIABLE.includes(text(licenseName)),
  };
}

const text = (value: unknown): string => (typeof value === "string" ? value.trim() : "");

/** A web address; others, such as scripts, must not become links. */
function address(value: unknown): string | undefined {
  return /^https?:\/\//i.test(text(value)) ? text(value) : undefined;
}
