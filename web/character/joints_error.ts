/** The error of a skeleton whose joints cannot be told: it carries what a person needs to choose them. */
import { type ErrorParts, StrutError } from "../engine/errors";
import type { Role } from "../humanoid";

/** What a {@link JointsError} is made of. */
export interface JointsErrorParts extends ErrorParts {
  missing: readonly Role[];
  joints: readonly string[];
  roles: Readonly<Partial<Record<Role, string>>>;
}

/** A `bad-file` whose joints a person can choose: `loadCharacter(source, { roles })`. */
export class JointsError extends StrutError {
  /** Roles that a body needs and that have no joint, all of them; empty where the joints are there but do not make a human. */
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
