// What fills the partition for data, as a block of the view of the PC.
import { css, html, nothing } from 'lit';
import type { MachineData } from '../core/machine';
import { bytesText, dataParts, dataSentence, isNearlyFull } from './machine_words';

export const machineDataStyles = css`
  table.data {
    width: auto;
    min-width: min(24rem, 100%);
  }
`;

/** `remove`: the button that removes old logs. */
export function dataBlock(data: MachineData | undefined, remove: unknown): unknown {
  if (!data) return nothing;
  const full = isNearlyFull(data);
  return html`
    <h3>Data partition</h3>
    <p>${dataSentence(data)}</p>
    <progress aria-label="Used of the data partition" max=${data.used + data.free} value=${data.used}></progress>
    ${full ? html`<p class="warning">⚠ Less than 10 % is free for the application. When it is full, the cell goes on, and nothing more can be saved.</p>` : nothing}
    <table class="data">
      <caption>What fills it${data.complete ? '' : ', of the first 20 000 files'}</caption>
      <thead><tr><th scope="col">Part</th><th scope="col" class="number">Size</th></tr></thead>
      <tbody>${dataParts(data).map(([name, bytes]) => html`
        <tr><th scope="row">${name}</th><td class="number">${bytesText(bytes)}</td></tr>`)}
      </tbody>
    </table>
    ${remove}`;
}
