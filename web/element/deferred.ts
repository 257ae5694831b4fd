/** A promise that is settled from outside. */
export class Deferred {
  readonly promise: Promise<void>;
  isSettled = false;
  resolve!: () => void;
  reject!: (reason: unknown) => void;

  constructor() {
    this.promise = new Promise((resolve, reject) => {
      this.resolve = () => {
        this.isSettled = true;
        resolve();
      };
      this.reject = (reason) => {
        this.isSettled = true;
        reject(reason);
      };
    });
    // Prevents an unhandled rejection if no caller awaits it.
    this.promise.catch(() => undefined);
  }
}
