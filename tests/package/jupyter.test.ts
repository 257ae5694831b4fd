/** The Python side of `examples/jupyter/`: its traits, and bytes as sent by a browser. */
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { expect, onTestFinished, test } from "vitest";
import { root } from "../recordings";

const python = [process.env.STRUT_PYTHON, "python3"].find((program) => {
  try {
    execFileSync(program ?? "", ["-c", "import anywidget"], { stdio: "pipe" });
    return true;
  } catch {
    return false;
  }
});
if (!python) console.warn("skipping: no Python with anywidget (pip install anywidget) as python3 or $STRUT_PYTHON");

const SCRIPT = `from strut_widget import Walk
walk = Walk(styles={"old": 0.5})
try:
    walk.save("early.bvh")
except ValueError as error:
    print(error)
try:
    walk.styles = {"old": "much"}
except Exception as error:
    print(type(error).__name__)
walk.set_state({"bvh": memoryview(b"HIERARCHY"), "frame": 7})
walk.save("styled.bvh")
print(walk.frame, walk.styles, walk.source)
`;

test.skipIf(!python)("a widget has its traits, and saves what the browser sends", () => {
  const folder = mkdtempSync(join(tmpdir(), "strut-jupyter-"));
  onTestFinished(() => rmSync(folder, { recursive: true }));
  cpSync(join(root, "examples", "jupyter", "strut_widget.py"), join(folder, "strut_widget.py"));
  writeFileSync(join(folder, "strut_widget.js"), "export default {};");
  const printed = execFileSync(python!, ["-c", SCRIPT], { cwd: folder, encoding: "utf8" });
  expect(printed.trim().split("\n")).toEqual([
    "The walk is not styled yet: show the widget first.",
    "TraitError",
    "7 {'old': 0.5} strut:neutral-walk",
  ]);
  expect(readFileSync(join(folder, "styled.bvh"), "utf8")).toBe("HIERARCHY");
});
