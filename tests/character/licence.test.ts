/** All licence values of VRM 0 and 1, and glTF copyright notices. */
import { expect, test } from "vitest";
import { licenceOf } from "../../web/character/licence";
import { loadCharacter } from "../../web/character/load";
import { movingAnimation } from "../humanoid_animation";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";

const vrm1 = (meta: object) => licenceOf({ extensions: { VRMC_vrm: { meta } } })!;
const vrm0 = (meta: object) => licenceOf({ extensions: { VRM: { meta } } })!;
const notice = (copyright: string) => licenceOf({ asset: { copyright } });

test.each([
  ["everyone", true],
  ["onlySeparatelyLicensedPerson", false],
  ["onlyAuthor", false],
  [undefined, false],
  ["something new", false],
])("VRM 1: avatarPermission %s lets everybody perform: %s", (avatarPermission, everybody) => {
  expect(vrm1({ avatarPermission }).everybody).toBe(everybody);
});

test.each([
  ["allowModificationRedistribution", true, true],
  ["allowModificationRedistribution", false, false],
  ["allowModificationRedistribution", undefined, false],
  ["allowModification", true, false],
  ["prohibited", true, false],
  [undefined, true, false],
])(
  "VRM 1: modification %s and redistribution %s allow an export: %s",
  (modification, allowRedistribution, mayExport) => {
    expect(vrm1({ modification, allowRedistribution }).mayExport).toBe(mayExport);
  },
);

test.each([
  ["unnecessary", false],
  ["required", true],
  [undefined, true],
])("VRM 1: creditNotation %s asks for credit: %s", (creditNotation, credit) => {
  expect(vrm1({ creditNotation }).credit).toBe(credit);
});

test.each([
  ["Everyone", true],
  ["ExplicitlyLicensedPerson", false],
  ["OnlyAuthor", false],
  [undefined, false],
])("VRM 0: allowedUserName %s lets everybody perform: %s", (allowedUserName, everybody) => {
  expect(vrm0({ allowedUserName }).everybody).toBe(everybody);
});

test.each([
  ["CC0", true, false],
  ["CC_BY", true, true],
  ["CC_BY_NC", true, true],
  ["CC_BY_SA", true, true],
  ["CC_BY_NC_SA", true, true],
  ["CC_BY_ND", false, true],
  ["CC_BY_NC_ND", false, true],
  ["Redistribution_Prohibited", false, true],
  ["Other", false, true],
  [undefined, false, true],
])("VRM 0: licence %s allows an export: %s, and asks for credit: %s", (licenseName, mayExport, credit) => {
  expect(vrm0({ licenseName })).toMatchObject({ mayExport, credit });
});

test.each([
  ["VRM 1", vrm1, "commercialUsage", ["personalNonProfit", "personalProfit", "corporation"]],
  ["VRM 1", vrm1, "allowExcessivelyViolentUsage", [true, false]],
  ["VRM 1", vrm1, "allowExcessivelySexualUsage", [true, false]],
  ["VRM 1", vrm1, "allowPoliticalOrReligiousUsage", [true, false]],
  ["VRM 1", vrm1, "allowAntisocialOrHateUsage", [true, false]],
  ["VRM 0", vrm0, "violentUssageName", ["Disallow", "Allow"]],
  ["VRM 0", vrm0, "sexualUssageName", ["Disallow", "Allow"]],
  ["VRM 0", vrm0, "commercialUssageName", ["Disallow", "Allow"]],
] as const)("%s: what %s says is between the author and who performs", (_, licence, field, values) => {
  for (const value of values) expect(licence({ [field]: value })).toEqual(licence({}));
});

const PERMISSIONS_1 = ["onlyAuthor", "onlySeparatelyLicensedPerson", "everyone"];
const MODIFICATIONS = ["prohibited", "allowModification", "allowModificationRedistribution"];
const USERS_0 = ["OnlyAuthor", "ExplicitlyLicensedPerson", "Everyone"];
const LICENCES_0 = ["Redistribution_Prohibited", "CC0", "CC_BY", "CC_BY_NC", "CC_BY_SA", "CC_BY_NC_SA"].concat([
  "CC_BY_ND",
  "CC_BY_NC_ND",
  "Other",
]);

/** All combinations of deciding values, with the expected result. */
const ALL = [
  ...PERMISSIONS_1.flatMap((avatarPermission) =>
    MODIFICATIONS.flatMap((modification) =>
      [true, false].map((allowRedistribution) => ({
        family: "VRM 1",
        meta: { avatarPermission, modification, allowRedistribution },
        asks: avatarPermission !== "everyone",
        exports: modification === "allowModificationRedistribution" && allowRedistribution,
      })),
    ),
  ),
  ...USERS_0.flatMap((allowedUserName) =>
    LICENCES_0.map((licenseName) => ({
      family: "VRM 0",
      meta: { allowedUserName, licenseName },
      asks: allowedUserName !== "Everyone",
      exports: licenseName.startsWith("CC") && !licenseName.endsWith("ND"),
    })),
  ),
];

test("a loaded VRM asks and exports as its licence says, whatever that says, and its motion alone always goes out", async () => {
  const { times, ...moving } = movingAnimation();
  const motion = { ...moving, timeOut: times };
  for (const { family, meta, asks, exports } of ALL) {
    const of = JSON.stringify(meta);
    const { glb } = makeRig(FAMILIES.find(({ name }) => name === family)!, {
      document: ({ extensions }) => {
        Object.assign((extensions!.VRMC_vrm ?? extensions!.VRM)!.meta as object, meta);
      },
    });
    const refused = loadCharacter(glb.slice().buffer).then(
      (character) => character.dispose(),
      ({ code }) => code,
    );
    expect(await refused, of).toBe(asks ? "licence" : undefined);
    const character = await loadCharacter(glb.buffer, { accept: () => true });
    const exported = () => character.toGLB(motion);
    if (exports) expect(exported, of).not.toThrow();
    else expect(exported, of).toThrow(/does not allow redistribution/);
    expect(character.toClip(motion).tracks.length, of).toBeGreaterThan(20);
    character.dispose();
  }
});

test("names, authors and web addresses are shown, and other addresses are not", () => {
  const shown = vrm1({ name: "A", authors: ["B", 3], licenseUrl: "https://c.org/d" });
  expect(shown).toMatchObject({ title: "A", authors: ["B"], url: "https://c.org/d" });
  expect(vrm1({ licenseUrl: "javascript:alert(1)" }).url).toBeUndefined();
  expect(vrm0({ title: "A", author: "B" })).toMatchObject({ title: "A", authors: ["B"] });
});

test("a VRM that says nothing on its use allows nothing", () => {
  expect(licenceOf({ extensions: { VRMC_vrm: {} } })).toMatchObject({
    credit: true,
    everybody: false,
    mayExport: false,
  });
});

test("a copyright notice is shown, and forbids exports where it says so", () => {
  expect(notice("© 2026 A, CC BY 4.0")).toMatchObject({
    title: "© 2026 A, CC BY 4.0",
    credit: true,
    everybody: true,
    mayExport: true,
  });
  for (const text of ["CC BY-ND 4.0", "CC-BY-NC-ND", "No derivatives", "All rights reserved"])
    expect(notice(text)!.mayExport, text).toBe(false);
  expect(notice("Andersen and Lund")!.mayExport).toBe(true);
  expect(licenceOf({})).toBeUndefined();
});
