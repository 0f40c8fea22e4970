// The scores of the jobs that wait in a queue, as a list of small bars: the highest first.
import { html, nothing, svg } from 'lit';
import { significantText } from '../core/units';

/** As topic "queues" has them: what is no number comes as null. */
export type Scores = readonly (number | null)[];

/** Bars in a box 100 high and one wide for each score, up or down from zero; what is no number has none. */
export function barsPath(scores: Scores): string {
  const numbers = scores.filter((score) => score !== null);
  const high = Math.max(0, ...numbers);
  const low = Math.min(0, ...numbers);
  const span = high > low ? high - low : 1;
  const y = (score: number): string => ((100 * (high - score)) / span).toFixed(1);
  return scores.map((score, i) => (score === null ? '' : `M${(i + 0.1).toFixed(1)} ${y(0)}V${y(score)}h0.8V${y(0)}z`)).join('');
}

/** "2 to 0.25", "0.5"; empty: none. */
export function scoresText(scores: Scores): string {
  const numbers = scores.filter((score) => score !== null);
  const [highest, lowest] = [numbers[0], numbers.at(-1)].map((score) => (score === undefined ? '' : significantText(score, 3)));
  return highest === lowest ? highest! : `${highest} to ${lowest}`;
}

/** `places`: jobs for which the queue has room, so that bars keep their width; `by`: the score's field. */
export function scoreBars(scores: Scores, fill: number, places: number, by: string): unknown {
  if (scores.length === 0) return nothing;
  const shown = scores.length < fill ? `, the highest ${scores.length}` : '';
  const text = scoresText(scores);
  return html`<svg
      class="scores"
      viewBox="0 0 ${Math.max(places, scores.length)} 100"
      preserveAspectRatio="none"
      role="img"
      aria-label="${by} of what waits${shown}: ${text}"
    >
      ${svg`<path d=${barsPath(scores)} />`}
    </svg>
    <span class="score-range">${text}</span>`;
}
