// The PC on which the application runs: its versions, why it does not permit motion, and updating it.
import { css, html, nothing } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { MachineWatch, type MachineSlot, type MachineState, type SlotName } from '../core/machine';
import { MachineActs } from './machine_acts';
import { machineButton, machineButtonStyles } from './machine_button';
import { dataBlock, machineDataStyles } from './machine_data';
import { failureBlock, machineFailureStyles } from './machine_failure';
import './machine_hosts';
import './machine_network';
import { ageOf, bootSentence, builtText, bytesText, chosenDrivers, confirmedSentence, motionSentence, otherSlot, slotSentence, updateSentence } from './machine_words';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';

@customElement('flexrf-machine')
export class Machine extends ViewBase {
  static override styles = [
    ...viewStyles,
    machineButtonStyles,
    machineDataStyles,
    machineFailureStyles,
    css`
      progress {
        width: min(24rem, 100%);
        height: 1em;
        accent-color: var(--fill);
      }
      label.file {
        margin-block: 0.8em;
        display: grid;
        gap: 2px;
        justify-items: start;
      }
      input[type='file'] {
        max-width: 100%;
        min-height: var(--target);
      }
      input[type='file']::file-selector-button {
        font: inherit;
        min-height: var(--target);
      }
      td {
        overflow-wrap: anywhere;
      }
    `,
  ];

  @state() private file: File | undefined;
  private acts!: MachineActs;
  private machine!: MachineWatch;

  override connectedCallback(): void {
    super.connectedCallback();
    this.acts = MachineActs.of(this.core);
    this.watchAge();
    this.machine = MachineWatch.of(this.core);
    this.until(this.machine.watch(() => this.requestUpdate()));
    this.until(this.machine.look());
    this.until(this.core.watchState(() => this.requestUpdate()));
    this.until(this.acts.watch(() => {
      if (this.acts.upload.isSending) this.file = undefined; // another upload is of another file
      this.requestUpdate();
    }));
  }

  protected override render(): unknown {
    const { machine } = this;
    if (!this.core.hasMachine) return html`<h2>Machine</h2><p>This application does not run on a PC of FlexRF.</p>`;
    const known = machine.state;
    const old = this.age || (machine.trouble ? 'stale' : '');
    return html`
      <h2>Machine</h2>
      ${machine.trouble ? html`<p class="alarm" role="alert">⚠ How the PC is cannot be told now. ${machine.trouble}</p>` : nothing}
      ${known ? html`<div class=${old}>${this.about(known)}${this.slots(known)}${this.updating(known)}
          <flexrf-machine-network .core=${this.core} .host=${this.host}></flexrf-machine-network>
          <flexrf-machine-hosts .core=${this.core} .host=${this.host}></flexrf-machine-hosts>${this.data(known)}${this.restart(known)}</div>`
        : machine.trouble ? nothing : html`<p>Waiting for the PC…</p>`}
    `;
  }

  private about(known: MachineState): unknown {
    const { denied } = this.acts;
    return html`
      ${denied ? html`<p class="muted" id="denied">An update, a choice of the slot, an address and a restart are an admin's: ${denied}.</p>` : nothing}
      <dl>
        <dt>Application</dt><dd>${known.application}</dd>
        <dt>Version</dt><dd>${known.version}, built ${builtText(known)}</dd>
        <dt>Drivers</dt><dd>${chosenDrivers(this.core.model.drivers)}</dd>
        <dt>Runs from</dt><dd class=${known.boot === 'fallback' || known.boot === 'unknown' ? 'warning' : ''}>${bootSentence(known)}</dd>
        <dt>Confirmed</dt><dd>${confirmedSentence(known)}
          ${known.confirmed ? nothing : html`<br /><progress aria-label="Healthy so far" max=${known.healthy_needed_s} value=${known.healthy_for_s}></progress>`}</dd>
        <dt>Motion</dt><dd class=${known.motion === 'permitted' ? '' : 'warning'}>${motionSentence(known)}</dd>
        ${known.development_key ? html`<dt>Signed</dt><dd class="warning">⚠ With the development key, which anybody has: anyone can make an update for this PC. Make an image with a key of your own for a PC that is used.</dd>` : nothing}
      </dl>
      ${failureBlock(known.last_failure, this.button('Dismiss', '', () => this.acts.askDismissFailure(this.machine.state!.last_failure!)))}
      ${known.notices.length === 0 ? nothing : html`<h3>Notices</h3><ul>${known.notices.map((notice) => html`<li>${notice}</li>`)}</ul>`}
    `;
  }

  private slots(known: MachineState): unknown {
    const rows = (['A', 'B'] as const).flatMap((name) => (known.slots[name] ? [[name, known.slots[name]] as const] : []));
    return html`
      <h3>Slots</h3>
      <table>
        <caption>Two places on the disk, each for a whole version: one runs, the other one is for an update.</caption>
        <thead><tr><th scope="col">Slot</th><th scope="col">Version</th><th scope="col">State</th></tr></thead>
        <tbody>${rows.map(([name, slot]) => html`
          <tr><th scope="row">${name}</th><td>${slot.version || '–'}</td><td>${slotSentence(known, name, slot)}</td></tr>`)}
        </tbody>
      </table>
      ${rows.map(([name, slot]) => this.choice(known, name, slot))}
    `;
  }

  private choice(known: MachineState, name: SlotName, slot: MachineSlot): unknown {
    if (slot.primary || !slot.whole) return nothing;
    return this.button(`Start slot ${name} next`, this.acts.deniedByMotion(known), () => this.acts.askChoose(known, name));
  }

  private updating(known: MachineState): unknown {
    const { update } = known;
    const { upload } = this.acts;
    return html`
      <h3>Update</h3>
      <div role=${upload.isSending || update.phase === 'installing' ? nothing : 'status'}>${upload.state.step === 'sending' ? this.sending(upload.state) : nothing}
        ${upload.state.step === 'failed' ? html`<p class="alarm">✕ The upload stopped at ${bytesText(upload.state.sent)} of ${bytesText(upload.state.size)}. ${upload.state.why}</p>` : nothing}
        ${upload.isSending || upload.state.step === 'failed' ? nothing : this.phase(known)}
      </div>
      ${upload.isSending && !this.acts.denied ? html`<div class="buttons"><button @click=${() => upload.cancel()}>Give up the upload</button></div>` : nothing}
      ${upload.state.step === 'failed' && upload.state.resumable ? this.button('Go on with the upload', '', () => void upload.resume()) : nothing}
      ${update.phase === 'verified' && !upload.isSending
        ? this.button(ageOf(known, update) === 'older' ? 'Install the older version' : 'Install',
            known.confirmed ? this.acts.deniedByMotion(known) : 'the version that runs has not confirmed itself yet', () => this.acts.askInstall(known))
        : nothing}
      ${update.phase === 'installing' || update.phase === 'verifying' || upload.isSending ? nothing : this.choose()}
    `;
  }

  private sending({ sent, size, trouble }: { sent: number; size: number; trouble: string }): unknown {
    return html`
      <p>Uploading: ${bytesText(sent)} of ${bytesText(size)}. Leave this page open.</p>
      <progress aria-label="Uploaded" max=${size} value=${sent}></progress>
      ${trouble ? html`<p class="warning">⚠ ${trouble} It is tried again.</p>` : nothing}`;
  }

  private phase(known: MachineState): unknown {
    const { update } = known;
    switch (update.phase) {
      case 'receiving':
        return html`<p>An upload was begun, by another page perhaps: ${bytesText(update.received)} of ${bytesText(update.size)}.</p>`;
      case 'verifying':
        return html`<p>The PC checks who signed the update…</p><progress aria-label="Verified" max="100" value=${update.percent}></progress>`;
      case 'verified':
        return html`<p>Uploaded and verified: ${updateSentence(known)}</p>`;
      case 'installing':
        return html`<p>Version ${update.version} is written into slot ${otherSlot(known)}: ${update.percent} %. Do not switch the PC off; if the power goes, slot ${known.slot} starts.</p>
          <progress aria-label="Installed" max="100" value=${update.percent}></progress>`;
      case 'installed':
        return html`<p>Version ${update.version} is installed. It starts with the next restart, on trial.</p>`;
      case 'failed':
        return html`<p class="alarm">✕ The update failed: ${update.why}</p>`;
      default:
        return html`<p>There is none.</p>`;
    }
  }

  private choose(): unknown {
    if (this.acts.denied) return nothing;
    return html`
      <label class="file">File of an update (.raucb)
        <input type="file" accept=".raucb" @change=${(event: Event) => { this.file = (event.target as HTMLInputElement).files?.[0]; }} /></label>
      ${this.button('Upload', this.file ? this.file.size > 0 ? '' : 'the file is empty' : 'choose a file first', () => this.acts.askUpload(this.file!))}
    `;
  }

  private data({ data }: MachineState): unknown {
    return dataBlock(data, data && this.button('Remove old logs', data.old_logs > 0 ? '' : 'there are no old logs', () => this.acts.askRemoveLogs(data)));
  }

  private restart(known: MachineState): unknown {
    if (this.acts.denied) return nothing;
    return html`<h3>Restart</h3>
      ${this.button(known.update.phase === 'installed' ? 'Restart now' : 'Restart the PC', this.acts.deniedByMotion(known), () => this.acts.askRestart())}`;
  }

  /** Nothing for whoever is no admin. */
  private button(label: string, dead: string, act: () => void): unknown {
    return this.acts.denied ? nothing : machineButton(label, dead, act);
  }
}
