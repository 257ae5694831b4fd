/** Types of `quiz.mjs` for its tests. */
export interface QuizStrip {
  name: string;
  style: string;
  action: string;
}
export function keyOf(
  styles: readonly string[],
  actions: readonly string[],
  seed: number,
): { seed: number; strips: QuizStrip[] };
export function mark(answers: Record<string, string>, strips: readonly QuizStrip[]): string[];
export function answerSheet(names: readonly string[], styles: readonly string[]): string;
