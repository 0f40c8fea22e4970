// Why something was not done, in a sentence or two.
import type { Problem } from './protocol';

/** As the server says it. */
export function textOf(problem: Problem): string {
  return problem.detail ?? problem.reason ?? problem.title;
}

/** Of what was thrown, whatever that is. */
export function textOfError(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
