// Inputs and outputs of a unit or device, with what each is connected to.
import type { Component, Model } from '../core/descriptor';
import type { PortJson } from '../core/descriptor_json';

export interface Connection {
  readonly name: string;
  readonly kind: 'slot' | 'queue';
}

export interface Port {
  readonly name: string;
  readonly direction: 'in' | 'out';
  /** Type of what goes through it. */
  readonly type: string;
  readonly summary: string;
  /** ns; undefined: of any age. */
  readonly maxAge: number | undefined;
  /** Empty: not connected. Several of a range, or of an output that goes to several. */
  readonly connections: readonly Connection[];
}

type Connected = string | null | readonly string[] | undefined;

export function portsOf(model: Model, component: Component): Port[] {
  const { json } = model;
  // Of a device its interface's, then those of the driver that it has.
  const permitted = component.device?.drivers ?? [];
  const driver = permitted.find((one) => one.driver === model.drivers[component.name]) ?? permitted[0];
  const declared: readonly ({ inputs?: readonly PortJson[]; outputs?: readonly PortJson[] } | undefined)[] =
    component.kind === 'unit'
      ? [json.unit_types.find((type) => type.name === component.typeName)]
      : [json.interfaces.find((face) => face.name === component.typeName), json.drivers.find((one) => one.name === driver?.type)];
  const connected = component.unit ?? component.device;
  const inputs: { readonly [port: string]: Connected } = component.unit?.inputs ?? driver?.inputs ?? {};
  const outputs: { readonly [port: string]: Connected } = { ...connected?.outputs, ...driver?.outputs };

  const port = (direction: Port['direction'], row: PortJson, to: Connected): Port => ({
    name: row.name,
    direction,
    type: row.type ?? row.queue ?? '',
    summary: row.summary,
    maxAge: row.max_age_ns,
    connections: (to == null ? [] : typeof to === 'string' ? [to] : to).map((name) => ({
      name,
      kind: model.slotsByName.has(name) ? 'slot' : 'queue',
    })),
  });
  return [
    ...declared.flatMap((of) => of?.inputs ?? []).map((row) => port('in', row, inputs[row.name])),
    ...declared.flatMap((of) => of?.outputs ?? []).map((row) => port('out', row, outputs[row.name])),
  ];
}
