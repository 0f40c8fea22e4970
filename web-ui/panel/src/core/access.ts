// Who may do what now, and why not. The server decides; the page only says it beforehand.
import type { ItemInfo, Role } from '../contract';
import type { LinkStatus } from './core';
import type { ApplicationState, ControlSession, SessionInfo } from './protocol';

const order: readonly Role[] = ['viewer', 'operator', 'engineer', 'admin'];

export function includes(role: Role, least: Role): boolean {
  return order.indexOf(role) >= order.indexOf(least);
}

export interface Situation {
  readonly link: Pick<LinkStatus, 'phase' | 'stale'>;
  readonly session: SessionInfo | undefined;
  readonly state: ApplicationState | undefined;
}

/** "anna at 192.168.0.7". */
export function nameOf(session: ControlSession): string {
  const name = session.user || session.name;
  return session.local ? `${name} at the machine` : `${name} at ${session.address}`;
}

/** Whether this page's session holds the control token. */
export function hasControl(situation: Situation): boolean {
  return situation.state?.control.holder?.you === true;
}

/** Why nothing reaches the application: whatever needs it is dead. */
export function deniedLink(situation: Pick<Situation, 'link'>): string {
  if (situation.link.phase !== 'open') return 'link lost';
  return situation.link.stale ? 'values are old' : '';
}

/** Why the session may not do what needs this role, whoever has control. */
export function deniedRole(situation: Situation, role: Role): string {
  const link = deniedLink(situation);
  if (link) return link;
  if (situation.session?.lapsed) return 'log in again';
  return situation.session && includes(situation.session.role, role) ? '' : `needs ${role}`;
}

/** Why the session may not do what needs this role and the control token; empty when it may. */
export function deniedAction(situation: Situation, role: Role): string {
  const denied = deniedRole(situation, role);
  if (denied) return denied;
  if (situation.state?.mode === 'safe' || situation.state?.mode === 'ended') return 'the application ends';
  if (hasControl(situation)) return '';
  const holder = situation.state?.control.holder;
  return holder ? `${holder.user || holder.name} has control` : 'take control first';
}

/** Why a session may not take the control token; empty when it may ask for it. */
export function deniedControl(situation: Situation): string {
  const denied = deniedRole(situation, 'operator');
  if (denied) return denied;
  const { holder, wanted_by: wanted } = situation.state?.control ?? { holder: null, wanted_by: null };
  if (holder?.local && !situation.session?.local) return 'held at the machine';
  return wanted && !wanted.you ? `${wanted.user || wanted.name} asks for it already` : '';
}

/** Why nothing can be held now: what is held moves something, and ends with Stop motion. */
function deniedMotion({ state }: Situation): string {
  if (state?.motion.stopped) return 'motion is stopped';
  if (state?.motion.may_move) return '';
  return `motion is inhibited: ${state?.motion.start_refused || 'give Start motion'}`;
}

/** Why a control of this item is dead now, whatever kind of control it is; empty when it acts. */
export function locked(situation: Situation, item: (ItemInfo & { readonly absent?: string }) | undefined): string {
  if (!item) return 'unknown';
  if (item.role === undefined) return 'read only';
  if (item.absent !== undefined) return item.absent;
  if (item.kind === 'configuration') return 'changed by Edit';
  const denied = deniedAction(situation, item.role);
  if (denied || situation.state?.motion.may_move) return denied;
  if (item.scalar === 'hold') return deniedMotion(situation);
  return item.needs?.find((need) => need.key === undefined)?.reason ?? '';
}
