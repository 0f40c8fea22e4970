// What every view says of the PC below it, as long as it is so. Loaded where the application runs on one.
import { css, html } from 'lit';
import { customElement } from 'lit/decorators.js';
import { MachineWatch, trialOf, type MachineState, type UpdatePhase } from '../core/machine';
import { ShellPart } from './part';
import { shellStyles } from './styles';

export function lastingLines(state: MachineState | undefined): readonly string[] {
  if (!state) return [];
  const { update } = state;
  const trial = trialOf(state);
  const percent = update.phase === 'receiving' ? Math.floor((100 * update.received) / Math.max(update.size, 1)) : update.percent;
  const phases: { readonly [phase in UpdatePhase]?: string } = {
    receiving: `An update is being uploaded: ${percent} %`,
    verifying: 'An update is being verified',
    installing: `Version ${update.version} is being installed: ${percent} %. Nothing may move meanwhile`,
    installed: `Version ${update.version} is installed: it starts with the next restart`,
  };
  return [
    state.development_key ? 'Signed with the development key: anyone can make an update for this PC' : '',
    state.confirmed ? '' : `Version ${state.version} has not confirmed itself: healthy for ${state.healthy_for_s} of ${state.healthy_needed_s} s`,
    phases[update.phase] ?? '',
    trial ? `The address of ${trial.interface} is on trial: it is taken back in ${trial.remaining_s} s` : '',
  ].filter((line) => line !== '');
}

@customElement('flexrf-machine-lines')
export class MachineLines extends ShellPart {
  static override styles = [
    shellStyles,
    css`
      a {
        display: block;
        padding: 6px 12px;
        color: var(--flexrf-text);
        background: var(--flexrf-surface);
        border-block-start: 1px solid var(--flexrf-border);
        border-inline-start: 6px solid var(--flexrf-warning);
        text-decoration: none;
      }
      a:focus-visible {
        outline-offset: -3px;
      }
    `,
  ];

  private watch!: MachineWatch;

  override connectedCallback(): void {
    super.connectedCallback();
    this.watch = MachineWatch.of(this.core);
    this.until(this.watch.watch(() => this.requestUpdate()));
  }

  protected override render(): unknown {
    return lastingLines(this.watch.state).map((line) => html`<a href="#/machine">⚠ ${line}</a>`);
  }
}
