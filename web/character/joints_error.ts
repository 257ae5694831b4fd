/** The error of a skeleton whose joints cannot be identified. It contains the data that the user needs to choose them. */
import { type ErrorParts, StrutError } from "../engine/errors";
import type { Role } from "../humanoid";

/** Contents of a {@link JointsError} as plain data. */
interface JointsErrorParts extends ErrorParts {
  missing: readonly Role[];
  joints: readonly string[];
  roles: Readonly<Partial<Record<Role, string>>>;
}

/** A `bad-file` error whose joints the user can choose: `loadCharacter(source, { roles })`. */
export class JointsError extends StrutError {
  /** All required roles without a joint; empty if the joints exist but do not form a human. */
  readonly missing: readonly Role[];
  /** Names of all joints; parents come before their children. */
  readonly joints: readonly string[];
  /** Name of the joint of each role that was found. */
  readonly roles: Readonly<Partial<Record<Role, string>>>;

  constructor(parts: JointsErrorParts, cause?: unknown) {
    super(parts, cause);
    [this.missing, this.joints, this.roles] = [parts.missing, parts.joints, parts.roles];
  }
}
