// Sets up everything that a machine needs besides git and Node: packages, Rust, the WASM target, a browser. Each part
// installs only what is missing, and prints instructions if it cannot.
import { createHash } from "node:crypto";
import { existsSync, readFileSync, realpathSync, writeFileSync } from "node:fs";
import { homedir } from "node:os";
import { dirname, join } from "node:path";
import { findProgram, output, root, run, Sentence, step } from "./steps.mjs";

const MIN_RUST = [1, 88];
const WASM_TARGET = "wasm32-unknown-unknown";
const CARGO_BIN = join(process.env.CARGO_HOME ?? join(homedir(), ".cargo"), "bin");

/** Installs the packages of package-lock.json unless they are installed. */
export async function setupPackages() {
  const lock = createHash("sha256")
    .update(readFileSync(join(root, "package-lock.json")))
    .digest("hex");
  const stamp = join(root, "node_modules", ".strut-lock");
  if (existsSync(stamp) && readFileSync(stamp, "utf8") === lock) return;
  await step("Installing npm packages", async () => {
    await run("npm", ["ci", "--no-audit", "--no-fund", "--loglevel=error"]);
    writeFileSync(stamp, lock);
  });
}

/** Installs Debian packages. Returns false without apt or without permission to use it. */
export async function installDebian(packages) {
  const apt = findProgram("apt-get");
  if (!apt) return false;
  const asRoot = process.getuid?.() === 0;
  const sudo = asRoot ? undefined : findProgram("sudo");
  if (!asRoot && !(sudo && (await output(sudo, ["-n", "true"])) !== undefined)) return false;
  const [program, prefix] = asRoot ? [apt, []] : [sudo, ["-n", apt]];
  const env = { DEBIAN_FRONTEND: "noninteractive" };
  try {
    await run(program, [...prefix, "-qq", "update"], { env });
    await run(program, [...prefix, "-qq", "-y", "--no-install-recommends", "install", ...packages], { env });
  } catch {
    return false;
  }
  return true;
}

async function rustVersion(rustc) {
  const match = rustc && /rustc (\d+)\.(\d+)/.exec((await output(rustc, ["--version"])) ?? "");
  return match ? [Number(match[1]), Number(match[2])] : undefined;
}

const isRecent = (version) =>
  version !== undefined && (version[0] > MIN_RUST[0] || (version[0] === MIN_RUST[0] && version[1] >= MIN_RUST[1]));

/**
 * Finds or installs a Rust compiler and a C linker.
 * @returns the environment in which `cargo` is that compiler's.
 */
export async function setupRust() {
  const path = `${CARGO_BIN}:${process.env.PATH}`;
  if (!findProgram("cc")) {
    await step("Installing a C linker (Debian's gcc)", async () => {
      if (!(await installDebian(["gcc", "libc6-dev"])))
        throw new Sentence("Rust needs a C linker. Install gcc or clang, then run this again.");
    });
  }
  const rustc = findProgram("rustc", [CARGO_BIN]);
  if (isRecent(await rustVersion(rustc))) return { PATH: path };
  const rustup = findProgram("rustup", [CARGO_BIN]);
  if (rustup) {
    await step("Updating Rust with rustup", () => run(rustup, ["update", "stable", "--no-self-update"]));
    return { PATH: path, RUSTUP_TOOLCHAIN: "stable" };
  }
  return debianRust();
}

/** Finds or installs a C++ compiler, which compiles libFuzzer. */
export async function setupCxx() {
  const found = () => ["c++", "g++", "clang++"].some((name) => findProgram(name));
  if (found()) return;
  await step("Installing a C++ compiler (Debian's g++)", () => installDebian(["g++"]));
  if (!found()) throw new Sentence("libFuzzer needs a C++ compiler. Install g++ or clang, then run this again.");
}

/** Returns Debian's rustc-web and cargo-web: a recent compiler with the sources of its standard library. */
async function debianRust() {
  if (!isRecent(await rustVersion("/usr/bin/rustc")) || !existsSync("/usr/bin/cargo")) {
    await step("Installing Rust from Debian's packages (rustc-web, cargo-web)", async () => {
      const installed = await installDebian(["rustc-web", "cargo-web"]);
      if (!installed || !isRecent(await rustVersion("/usr/bin/rustc")))
        throw new Sentence(
          `Strut needs Rust ${MIN_RUST.join(".")} or newer. Install it with rustup, then run this again.`,
        );
    });
  }
  return { PATH: `/usr/bin:${process.env.PATH}`, RUSTC: "/usr/bin/rustc", CARGO: "/usr/bin/cargo" };
}

/**
 * Sets up the compiler for WebAssembly: uses the active toolchain's target if it is installed or rustup can add it,
 * else Debian's compiler with the standard library built from source.
 * @param rust environment of {@link setupRust}
 * @returns the environment in which cargo builds the packages (wasm.mjs).
 */
export async function setupWasm(rust) {
  const sysroot = rust.RUSTC === undefined && (await output("rustc", ["--print", "sysroot"], { env: rust }));
  const hasTarget = () => sysroot && existsSync(join(sysroot, "lib", "rustlib", WASM_TARGET, "lib"));
  if (hasTarget()) return rust;
  const rustup = sysroot && findProgram("rustup", [CARGO_BIN]);
  if (rustup) {
    await step(`Adding the ${WASM_TARGET} target with rustup`, async () => {
      const added = await output(rustup, ["target", "add", WASM_TARGET], { env: rust, cwd: join(root, "rust") });
      return added === undefined ? "not to be had; the standard library will be built from source" : "";
    });
    if (hasTarget()) return rust;
  }
  return wasmFromSource(sysroot);
}

async function wasmFromSource(sysroot) {
  const env = await debianRust();
  const source = "/usr/lib/rustlib/src/rust/library/Cargo.lock";
  let linker = findProgram("wasm-ld-19") ?? findRustLld(sysroot);
  if (!existsSync(source) || !linker) {
    await step("Installing the standard library's source and a WASM linker (rust-web-src, lld-19)", async () => {
      if (!(await installDebian(["rust-web-src", "lld-19"])))
        throw new Sentence(`The ${WASM_TARGET} target is missing. Run 'rustup target add ${WASM_TARGET}'.`);
    });
    linker = findProgram("wasm-ld-19");
  }
  return {
    ...env,
    RUSTC_BOOTSTRAP: "1",
    STRUT_BUILD_STD: "1",
    CARGO_TARGET_DIR: join(root, "rust", "target", "build-std"),
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER: linker,
  };
}

function findRustLld(sysroot) {
  const host = join("lib", "rustlib", `${process.arch === "arm64" ? "aarch64" : "x86_64"}-unknown-linux-gnu`, "bin");
  const path = sysroot && join(sysroot, host, "rust-lld");
  return path && existsSync(path) ? path : undefined;
}

const BROWSERS = {
  darwin: [
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
  ],
  win32: ["C:\\Program Files\\Google\\Chrome\\Application\\chrome.exe"],
};

function findBrowser() {
  const names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
  const known = [process.env.CHROME_PATH, ...(BROWSERS[process.platform] ?? [])];
  return known.find((path) => path && existsSync(path)) ?? names.map((name) => findProgram(name)).find(Boolean);
}

/** Mesa draws twice as fast as Chromium's own software renderer; the tests use it if it is installed. */
const MESA = ["libegl1", "libegl-mesa0", "libgl1-mesa-dri"];
/** Chromium without a user interface: it loads a page in half the CPU time. Debian has a package of it. */
const SHELL = "chromium-headless-shell";

/**
 * Finds or installs a Chromium for the browser tests, and its headless shell where Debian has it.
 * @returns the environment with CHROME_PATH and CHROME_SHELL_PATH; only the former if it was set before.
 */
export async function setupBrowser() {
  if (!findBrowser()) await step("Installing Chromium (Debian's package)", () => installDebian(["chromium", ...MESA]));
  const browser = findBrowser();
  if (!browser) throw new Sentence("The tests need Chrome or Chromium. Install one, or set CHROME_PATH.");
  if (process.env.CHROME_PATH) return { CHROME_PATH: browser };
  if (!findProgram(SHELL)) await installShell();
  const shell = findProgram(SHELL);
  return { CHROME_PATH: browser, ...(shell && { CHROME_SHELL_PATH: shell }) };
}

/** Installs the headless shell with the version of Debian's Chromium, which is not changed, if it is available. */
async function installShell() {
  const [, version] = (await output("dpkg-query", ["--show", "chromium"]))?.split("\t") ?? [];
  const shell = `${SHELL}=${version}`;
  if (version && (await output("apt-cache", ["show", shell])))
    await step("Installing Chromium's headless shell (Debian's package)", () => installDebian([shell]));
}

/**
 * Returns the software GPU of Chromium, for native GPU programs.
 * @returns the environment with its driver; empty if a driver is set, or there is none.
 */
export function softwareGraphics(browser) {
  if (process.env.VK_ICD_FILENAMES) return {};
  const folders = [dirname(realpathSync(browser)), "/usr/lib/chromium"];
  const files = ["vk_swiftshader_icd.json", "libvk_swiftshader.so", "libvulkan.so.1"];
  const folder = folders.find((folder) => files.every((file) => existsSync(join(folder, file))));
  return folder ? { VK_ICD_FILENAMES: join(folder, files[0]), LD_LIBRARY_PATH: folder } : {};
}

/** Throws a message if Node is too old. */
export function checkNode() {
  const major = Number(process.versions.node.split(".")[0]);
  if (major < 20) throw new Sentence(`Strut needs Node 20 or newer; this is ${process.versions.node}.`);
}
