/** Files that the operating system opens with the installed page: the `file_handlers` of `public/manifest.webmanifest`. */

/** https://wicg.github.io/web-app-launch/, which is not in TypeScript's library yet. */
interface LaunchQueue {
  setConsumer(take: (launch: { readonly files: readonly FileSystemFileHandle[] }) => void): void;
}

/** Calls back with the files with which the page was opened, and with those that it receives while it is open. */
export function onLaunchedFiles(open: (files: readonly File[]) => void): void {
  const { launchQueue } = globalThis as { launchQueue?: LaunchQueue };
  launchQueue?.setConsumer(async ({ files }) => {
    if (files.length > 0) open(await Promise.all(files.map((handle) => handle.getFile())));
  });
}
