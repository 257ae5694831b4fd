/** Browsers other than Chromium in which the tasks are tested. */
import { firefoxPath, launchFirefox } from "./firefox";
import { launchWebkit, webkitPath } from "./webkit";

export const BROWSERS = [
  { name: "Firefox", path: firefoxPath, launch: launchFirefox },
  { name: "WebKit", path: webkitPath, launch: launchWebkit },
];
