// Which acts a unit or device offers now, and why some are locked.
import type { Role } from '../contract';

export type Life = 'created' | 'initialised' | 'running' | 'stopped' | 'fault' | 'waiting';

/** A row of topic "components". */
export interface ComponentRow {
  readonly name: string;
  readonly kind: 'unit' | 'device';
  readonly type?: string;
  readonly driver?: string;
  readonly life: Life;
  /** Why it is in fault or waits; empty when it does neither. */
  readonly fault: string;
  /** Why it does less than it is commanded now; empty when it does all. */
  readonly restraint: string;
  /** How often that was so since the start. */
  readonly restraints: number;
  /** Steps beyond its budget, of a unit. */
  readonly budget_overruns: number;
  readonly active: boolean;
  readonly member: { readonly population: string; readonly index: number } | null;
  readonly steps: number;
  readonly execution: { readonly mean_ns: number; readonly max_ns: number };
}

export type ActionName = 'start' | 'stop' | 'initialise' | 'activate' | 'clone' | 'retire';

export interface ActionOffer {
  readonly action: ActionName;
  readonly label: string;
  /** What it does, in a sentence. */
  readonly effect: string;
  readonly role: Role;
  /** Why the component's own state does not permit it; empty when it does. */
  readonly locked: string;
}

/** In the order in which they are shown; what never applies is left out. */
export function actionsOf(row: ComponentRow): ActionOffer[] {
  const offers: ActionOffer[] = [
    {
      action: 'start', label: 'Start', role: 'engineer',
      effect: 'Initialises it, and what it stands on. Nothing moves before the next Start of motion.',
      locked: row.life === 'running' ? 'It is running.' : '',
    },
    {
      action: 'stop', label: 'Stop', role: 'engineer',
      effect: 'Stops it, and before it what stands on it; what they write becomes NULL.',
      locked: row.life === 'created' || row.life === 'stopped' ? 'It is not running.' : '',
    },
    {
      action: 'initialise', label: 'Initialise', role: 'engineer',
      effect: 'Stops it and what stands on it, and starts it all anew. Nothing moves before the next Start of motion.',
      locked: '',
    },
  ];
  if (row.member !== null) {
    const running = row.life === 'running' ? '' : 'It is not running.';
    offers.push(
      {
        action: 'activate', label: 'Activate', role: 'operator',
        effect: 'Has this member stepped, with the settings it has.',
        locked: row.active ? 'It is active.' : running,
      },
      {
        action: 'clone', label: 'Clone', role: 'operator',
        effect: 'Activates this member with the settings of another.',
        locked: row.active ? 'It is active: only one that is not can become a clone.' : running,
      },
      {
        action: 'retire', label: 'Retire', role: 'operator',
        effect: 'Has this member stepped no more; what it writes becomes NULL.',
        locked: row.active ? '' : 'It is not active.',
      },
    );
  }
  return offers;
}

/** What a person should look at first: faults, then what does not run, then the rest, each in the tables' order. */
export function urgency(row: Pick<ComponentRow, 'life' | 'active'>): number {
  if (row.life === 'fault') return 0;
  return row.life === 'running' || !row.active ? 2 : 1;
}

/** The word for its state: a member that sleeps is no fault. */
export function stateText(row: Pick<ComponentRow, 'life' | 'active' | 'member'>): string {
  if (row.member !== null && !row.active && row.life === 'running') return 'ready, not active';
  return row.life === 'fault' ? 'in fault' : row.life;
}

/** A body of topic "components"; what is not of its form is left out. */
export function componentRows(body: unknown): ComponentRow[] {
  if (!Array.isArray(body)) return [];
  return body.filter((row): row is ComponentRow => typeof row === 'object' && row !== null && typeof row.name === 'string');
}
