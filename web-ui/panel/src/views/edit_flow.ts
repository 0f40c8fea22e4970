// Editing configuration parameters: what the page is at, from Edit to the outcome. Knows no document.
import type { Value } from '../contract';
import { sameValue } from '../core/same_value';

/** Values of components by name, then by parameter. */
export type Configuration = { readonly [component: string]: { readonly [parameter: string]: Value } };

export interface Change {
  readonly component: string;
  readonly values: { readonly [parameter: string]: Value };
}

export type Outcome = 'done' | 'refused' | 'rolled_back' | 'fault';

export type BeginAnswer =
  | {
      readonly ok: true;
      readonly edit: string;
      /** In order of stopping: owners of actuators first. */
      readonly reinitialised: readonly string[];
      readonly configuration: Configuration;
    }
  | { readonly ok: false; readonly detail: string; readonly moving: readonly string[] };

export type ApplyAnswer =
  | { readonly ok: true; readonly outcome: Outcome; readonly causes: readonly string[]; readonly owners: readonly string[] }
  | { readonly ok: false; readonly detail: string };

/** The server's side of an edit; no function rejects. */
export interface EditLink {
  begin(components: readonly string[]): Promise<BeginAnswer>;
  apply(edit: string, changes: readonly Change[]): Promise<ApplyAnswer>;
  discard(edit: string): void;
}

/** What an edit in progress holds. */
export interface Draft {
  readonly edit: string;
  readonly reinitialised: readonly string[];
  readonly configuration: Configuration;
  /** Edited values only: those that differ from the ones in force. */
  readonly changed: Configuration;
  /** Why an edited value cannot be applied, by "component.parameter". */
  readonly invalid: { readonly [key: string]: string };
  /** When the server discards it, ms of the flow's clock. */
  readonly endsAt: number;
  /** What became of the last Apply, and why; empty before it. */
  readonly failure: '' | 'refused' | 'rolled_back';
  readonly causes: readonly string[];
}

export type EditState =
  | { readonly step: 'closed' }
  | { readonly step: 'opening'; readonly components: readonly string[] }
  | { readonly step: 'denied'; readonly detail: string; readonly moving: readonly string[]; readonly components: readonly string[] }
  | { readonly step: 'editing'; readonly draft: Draft }
  | { readonly step: 'applying'; readonly draft: Draft }
  | {
      readonly step: 'applied';
      readonly outcome: 'done' | 'fault';
      readonly causes: readonly string[];
      readonly owners: readonly string[];
    }
  | { readonly step: 'ended'; readonly reason: string };

/** Who edits, as the server's `state` says: this session, another, or nobody. */
export type Editor = 'you' | 'other' | 'nobody';

/** ms that the server leaves an edit open, until it says how many are left. */
const lifetime = 300_000;

export interface EditFlowOptions {
  readonly link: EditLink;
  /** Why a value cannot be in force; empty when it can as far as the page knows. */
  readonly check: (component: string, parameter: string, value: Value) => string;
  /** ms, only rising. */
  readonly now: () => number;
  readonly changed: () => void;
}

export class EditFlow {
  private current: EditState = { step: 'closed' };
  /** The server's `state` has named this session as the editor: from then on its silence about it means the end. */
  private confirmed = false;

  constructor(private readonly options: EditFlowOptions) {}

  get state(): EditState {
    return this.current;
  }

  /** The draft while there is one. */
  get draft(): Draft | undefined {
    return this.current.step === 'editing' || this.current.step === 'applying' ? this.current.draft : undefined;
  }

  /** ms until the server discards the edit; 0 when there is none. */
  get left(): number {
    const draft = this.draft;
    return draft === undefined ? 0 : Math.max(0, draft.endsAt - this.options.now());
  }

  /** The value that Apply would leave in force. */
  value(component: string, parameter: string): Value | undefined {
    const draft = this.draft;
    return draft?.changed[component]?.[parameter] ?? draft?.configuration[component]?.[parameter];
  }

  isChanged(component: string, parameter: string): boolean {
    return this.draft?.changed[component]?.[parameter] !== undefined;
  }

  get changes(): Change[] {
    return Object.entries(this.draft?.changed ?? {}).map(([component, values]) => ({ component, values }));
  }

  /** Why Apply is not possible now; empty when it is. */
  get cannotApply(): string {
    if (this.current.step !== 'editing') return 'nothing is being edited';
    if (this.changes.length === 0) return 'nothing was changed';
    const first = Object.values(this.current.draft.invalid)[0];
    return first ?? '';
  }

  async open(components: readonly string[]): Promise<void> {
    if (this.draft !== undefined || this.current.step === 'opening') return;
    const opening: EditState = { step: 'opening', components };
    this.go(opening);
    const answer = await this.options.link.begin(components);
    if (this.state !== opening) {
      // The person thought better of it while the server was asked.
      if (answer.ok) this.options.link.discard(answer.edit);
      return;
    }
    if (!answer.ok) {
      this.go({ step: 'denied', detail: answer.detail, moving: answer.moving, components });
      return;
    }
    this.confirmed = false;
    const { edit, reinitialised, configuration } = answer;
    const endsAt = this.options.now() + lifetime;
    const untouched = { changed: {}, invalid: {}, failure: '', causes: [] } as const;
    this.go({ step: 'editing', draft: { edit, reinitialised, configuration, endsAt, ...untouched } });
  }

  change(component: string, parameter: string, value: Value): void {
    if (this.current.step !== 'editing') return;
    const { draft } = this.current;
    const before = draft.configuration[component]?.[parameter];
    if (before === undefined) return;
    const { [parameter]: _dropped, ...others } = draft.changed[component] ?? {};
    const values = sameValue(before, value, 'f64') ? others : { ...others, [parameter]: value };
    const { [component]: _values, ...rest } = draft.changed;
    const changed = Object.keys(values).length === 0 ? rest : { ...rest, [component]: values };
    const key = `${component}.${parameter}`;
    const { [key]: _reason, ...valid } = draft.invalid;
    const reason = values[parameter] === undefined ? '' : this.options.check(component, parameter, value);
    const invalid = reason === '' ? valid : { ...valid, [key]: reason };
    this.go({ step: 'editing', draft: { ...draft, changed, invalid, failure: '', causes: [] } });
  }

  revert(component: string, parameter: string): void {
    const before = this.draft?.configuration[component]?.[parameter];
    if (before !== undefined) this.change(component, parameter, before);
  }

  async apply(): Promise<void> {
    if (this.current.step !== 'editing' || this.cannotApply !== '') return;
    const { draft } = this.current;
    const applying: EditState = { step: 'applying', draft };
    this.go(applying);
    const answer = await this.options.link.apply(draft.edit, this.changes);
    if (this.state !== applying) return;
    if (!answer.ok) {
      this.go({ step: 'editing', draft: { ...draft, failure: 'refused', causes: [answer.detail] } });
    } else if (answer.outcome === 'refused' || answer.outcome === 'rolled_back') {
      // What was in force is in force; the edit lives on, to be corrected.
      this.go({ step: 'editing', draft: { ...draft, failure: answer.outcome, causes: answer.causes } });
    } else {
      this.go({ step: 'applied', outcome: answer.outcome, causes: answer.causes, owners: answer.owners });
    }
  }

  /** Gives an edit up, or puts away what is shown of one that is over. */
  discard(): void {
    if (this.current.step === 'applying') return;
    if (this.current.step === 'editing') this.options.link.discard(this.current.draft.edit);
    this.go({ step: 'closed' });
  }

  /** Now and then: the server discards an edit that was left open. */
  tick(): void {
    if (this.current.step === 'editing' && this.left === 0) {
      this.go({ step: 'ended', reason: 'The edit was left open too long and was discarded. Nothing was changed.' });
    }
  }

  /** Each `state` of the server; `left`: ms until it discards the edit there is. */
  serverSays(editor: Editor, left = lifetime): void {
    if (this.current.step !== 'editing') return;
    if (editor === 'you') {
      this.confirmed = true;
      // Each Apply begins the time anew; no need to draw for it.
      this.current = { ...this.current, draft: { ...this.current.draft, endsAt: this.options.now() + left } };
    } else if (editor === 'other' || this.confirmed) {
      const why = editor === 'other' ? 'Another session edits now.' : 'The control token or the link was lost, or the time is over.';
      this.go({ step: 'ended', reason: `The edit was discarded. ${why} Nothing was changed.` });
    }
  }

  private go(state: EditState): void {
    this.current = state;
    this.options.changed();
  }
}
