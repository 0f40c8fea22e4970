// What the helper of a PC says, as docs/panel-protocol.md has it.
import type { MachineState, MachineUpdate } from '../machine';

export const noUpdate: MachineUpdate = {
  phase: 'none', received: 0, size: 0, percent: 0, version: '', application: '', older: false, why: '',
};

export const pc: MachineState = {
  application: 'pick-station', version: '20261128T001500Z-4fb48992', built: 1795824900, slot: 'A', boot: 'confirmed', confirmed: true,
  slots: {
    A: { version: '20261128T001500Z-4fb48992', whole: true, primary: true },
    B: { version: '', whole: false, primary: false },
  },
  motion: 'permitted', development_key: false, notices: [], healthy_for_s: 60, healthy_needed_s: 60, why_not_healthy: '', update: noUpdate,
};
