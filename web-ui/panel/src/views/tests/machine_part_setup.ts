// What the tests of the parts of the view of the PC begin with: an admin's core, the part in a page, and a PC that answers.
import { afterEach, beforeEach, expect, vi } from 'vitest';
import { FakeCore } from '../../core/tests/fake_core';
import { pc } from '../../core/tests/machine_sample';
import { MachineWatch, type MachineState } from '../../core/machine';
import { sample } from '../../core/tests/sample';
import type { MachinePart } from '../machine_part';

const admin = { name: 'panel-1', user: 'adam', role: 'admin', local: true } as const;

/** Anew for each test of the file that makes it. */
export class PartSetup<Part extends MachinePart> {
  core!: FakeCore;
  view!: Part;
  /** To every change that is asked of the PC. */
  readonly posted = vi.fn();
  /** What the PC tells from now on. */
  answer: object = pc;

  constructor(tag: string) {
    beforeEach(() => {
      this.posted.mockReset();
      this.posted.mockImplementation(() => Promise.resolve(new Response('{}')));
      this.answer = pc;
      vi.stubGlobal('fetch', (path: string, options: RequestInit) =>
        path === '/api/v1/machine' ? Promise.resolve(new Response(JSON.stringify(this.answer))) : this.posted(path, options) as Promise<Response>);
      this.core = new FakeCore(sample);
      this.core.hasMachine = true;
      this.core.session = admin;
      this.view = Object.assign(document.createElement(tag) as Part, { core: this.core.core, host: this.core.host });
      document.body.append(this.view);
    });
    afterEach(() => {
      document.body.replaceChildren();
      vi.useRealTimers();
      vi.unstubAllGlobals();
    });
  }

  /** The text of the part when the PC tells this beside `pc`. */
  shown(state: Partial<MachineState> = {}): Promise<string> { return this.told({ ...pc, ...state }); }
  /** The same when the PC tells just this. */
  async told(answer: object): Promise<string> {
    this.answer = answer;
    await MachineWatch.of(this.core.core).refresh();
    return this.text();
  }
  async text(): Promise<string> {
    await this.view.updateComplete;
    return this.view.shadowRoot!.textContent!.replace(/\s+/g, ' ').replaceAll(' ,', ',');
  }
  async types(input: HTMLInputElement, value: string): Promise<void> {
    input.value = value;
    input.dispatchEvent(new Event('input'));
    await this.view.updateComplete;
  }
  /** Why the button does nothing; empty: it acts. */
  reasonOf(button: HTMLButtonElement): string {
    const reason = this.view.shadowRoot!.getElementById(button.getAttribute('aria-describedby')!)!.textContent;
    expect(button.getAttribute('aria-disabled')).toBe(reason ? 'true' : null);
    return reason;
  }
}
