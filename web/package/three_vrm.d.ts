/** What is used of the optional peer `@pixiv/three-vrm`. */
declare module "@pixiv/three-vrm" {
  export const VRMLoaderPlugin: new (parser: unknown) => unknown;
}
