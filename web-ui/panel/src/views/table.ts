// A table as views show them: with a caption, a head, and the rows of the view.
import { html } from 'lit';

/** `rows`: of as many cells as there are columns; `numbers`: those of the columns that hold figures. */
export function table(caption: string, columns: readonly string[], rows: unknown, numbers: readonly string[] = []): unknown {
  return html`
    <table>
      <caption>
        ${caption}
      </caption>
      <thead>
        <tr>
          ${columns.map((name) => html`<th scope="col" class=${numbers.includes(name) ? 'number' : ''}>${name}</th>`)}
        </tr>
      </thead>
      <tbody>
        ${rows}
      </tbody>
    </table>
  `;
}
