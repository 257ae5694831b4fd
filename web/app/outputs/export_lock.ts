/** Whether something can be exported: an input must be open, and one export is made at a time. */
export class ExportLock {
  #hasInput = false;
  #isExporting = false;
  readonly #onChange: (can: boolean) => void;

  /** @param onChange called with whether an export can begin */
  constructor(onChange: (can: boolean) => void) {
    this.#onChange = onChange;
    this.#tell();
  }

  /** An input is open. */
  inputOpened(): void {
    this.#hasInput = true;
    this.#tell();
  }

  /** Makes an export, during which no other one can begin. */
  async run(make: () => Promise<void>): Promise<void> {
    this.#isExporting = true;
    this.#tell();
    try {
      await make();
    } finally {
      this.#isExporting = false;
      this.#tell();
    }
  }

  #tell(): void {
    this.#onChange(this.#hasInput && !this.#isExporting);
  }
}
