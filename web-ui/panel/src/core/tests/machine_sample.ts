// What the helper of a PC says, as docs/panel-protocol.md has it.
import type { MachineData, MachineFailure, MachineState, MachineUpdate, NetworkInterface, NetworkTrial } from '../machine';

export const noUpdate: MachineUpdate = {
  phase: 'none', received: 0, size: 0, percent: 0, version: '', application: '', older: false, driver_changes: [], why: '',
};

export const wired: NetworkInterface = {
  interface: 'enp0s2', mac: '52:54:00:12:34:56', link: true, addresses: ['10.0.2.15/24'], setting: 'image', address: '', gateway: '',
};

export const noTrial: NetworkTrial = { interface: '', remaining_s: 0 };

export const data: MachineData = {
  size: 250e6, used: 180e6, free: 32e6, configuration: 40e3, audit: 4e6, journal: 64e6, old_logs: 56e6, updates: 105e6, other: 200e3, complete: true,
};

export const failure: MachineFailure = {
  slot: 'B', version: '20261201T1', starts: 3, start: 3, began: 1795824900, reason: 'the panel says: device arm is in fault',
  lines: ['[   12.300000] pick-station[312]: device arm: no answer', '[   12.400000] pick-station[312]: the cell stops'], why_no_lines: '',
};

export const pc: MachineState = {
  application: 'pick-station', version: '20261128T001500Z-4fb48992', built: 1795824900, slot: 'A', boot: 'confirmed', confirmed: true,
  slots: {
    A: { version: '20261128T001500Z-4fb48992', whole: true, primary: true, driver_changes: [] },
    B: { version: '', whole: false, primary: false, driver_changes: [] },
  },
  motion: 'permitted', development_key: false, notices: [], healthy_for_s: 60, healthy_needed_s: 60, why_not_healthy: '', update: noUpdate,
  network: [wired], network_trial: noTrial, hosts: [],
};
