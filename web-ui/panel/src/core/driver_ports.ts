// What of the blackboard depends on which drivers the devices have.
import type { DescriptorJson, DeviceJson, SlotJson } from './descriptor_json';

export interface SlotUse {
  readonly writer: string;
  readonly readers: readonly string[];
  /** Why nobody writes it: the driver that would was not chosen. As the runtime says it (reason_text). */
  readonly unwritten?: string;
}

function whyUnwritten(writers: { readonly [driver: string]: string }, device: string): string {
  const names = Object.keys(writers).map((name) => `'${name}'`);
  return names.length === 1
    ? `written by driver ${names.join('')} of device '${device}', which was not chosen`
    : `written by drivers ${names.join(' and ')} of device '${device}', none of which was chosen`;
}

/** Of each slot, with the drivers that the devices have. */
export function slotUses(json: DescriptorJson, driverOf: (device: DeviceJson) => string): (slot: SlotJson) => SlotUse {
  const reads = new Set<string>(); // "port slot", by the driver that is there
  const wouldRead = new Set<string>(); // by another
  for (const device of json.devices) {
    for (const { driver, inputs } of device.drivers) {
      for (const [port, to] of Object.entries(inputs ?? {}))
        for (const slot of [to].flat())
          if (slot !== null) (driver === driverOf(device) ? reads : wouldRead).add(`${device.name}.${port} ${slot}`);
    }
  }
  return (slot) => {
    const readers = slot.readers.filter((reader) => {
      const read = `${reader} ${slot.name}`;
      return !wouldRead.has(read) || reads.has(read);
    });
    const writers = slot.driver_writers;
    if (!writers) return { writer: slot.writer, readers };
    const name = slot.writer.slice(0, slot.writer.lastIndexOf('.'));
    const device = json.devices.find((one) => one.name === name);
    const writer = device && writers[driverOf(device)];
    return writer === undefined ? { writer: slot.writer, readers, unwritten: whyUnwritten(writers, name) } : { writer, readers };
  };
}
