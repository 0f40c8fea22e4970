// Ending a session; logging in is a dialog that is loaded when it is opened.
import { postJson } from '../core/http';
import type { PanelCore } from '../core/panel_core';

export async function logOut(core: PanelCore): Promise<void> {
  const answer = await postJson('/api/v1/logout');
  if (!answer.ok) core.notify(`Logging out failed: ${answer.detail}`, 'warning');
  core.connection.restart();
}
