// What the page knows of the application before any value arrives: components, slots, and every item that can be shown.
import type { ItemInfo, Joint, Placement, Role, Value } from '../contract';
import { slotUses } from './driver_ports';
import type { Drivers } from './protocol';
import type {
  BlockJson, DescriptorJson, DeviceJson, InterfaceJson, OverrideJson, ParameterJson, QueueJson, SlotJson, ThreadJson, UnitJson,
} from './descriptor_json';
import { makeTypes, type Field, type Types } from './types';

/** An item with what only the core, the shell and the views need of it. */
export interface Item extends ItemInfo {
  /** Where its value comes from; undefined for configuration, which is asked for, and for what is not there. */
  readonly source?: Source;
  /** Why it is not there: it belongs to a driver that the device does not have now. */
  readonly absent?: string;
  readonly hidden: boolean;
  readonly menu: string;
  readonly place: string;
}

export interface Source {
  readonly slot: Slot;
  /** Lead to a field from the slot's value, one structure into the next; none: the whole value. */
  readonly fields: readonly Field[];
  /** Then from the field's value on: indices of elements, members of those. */
  readonly steps: readonly (string | number)[];
}

export interface Slot {
  readonly index: number;
  readonly name: string;
  readonly json: SlotJson;
  readonly image: boolean;
  /** Why nobody writes it with the drivers that there are. */
  readonly unwritten?: string;
  /** Of its whole value; its members are its fields. */
  readonly item: Item;
}

/** A unit or a device. */
export interface Component {
  readonly kind: 'unit' | 'device';
  readonly name: string;
  /** Of the unit's type, or of the interface. */
  readonly typeName: string;
  readonly summary: string;
  readonly thread: string;
  readonly population: string;
  readonly unit?: UnitJson;
  readonly device?: DeviceJson;
  /** Of a device: its interface's, and that of the driver that it has. */
  readonly configuration: readonly Item[];
  /** Of a device: the same with each driver that its row permits, by the driver's name. */
  readonly driverConfiguration: ReadonlyMap<string, readonly Item[]>;
  /** Of a device: its interface's, then those of the driver that it has. */
  readonly runtime: readonly Item[];
  readonly feedback: readonly Item[];
}

export interface Model {
  readonly json: DescriptorJson;
  /** That the devices have, as far as the server said. */
  readonly drivers: Drivers;
  /** 16 hexadecimal digits, as in every frame of values. */
  readonly hash: string;
  readonly application: string;
  readonly types: Types;
  readonly components: ReadonlyMap<string, Component>;
  readonly slots: readonly Slot[];
  readonly slotsByName: ReadonlyMap<string, Slot>;
  readonly queues: readonly QueueJson[];
  readonly threads: readonly ThreadJson[];
  /** By name of the menu entry, in the order of the tables. */
  readonly menus: ReadonlyMap<string, readonly Item[]>;
  readonly placements: readonly Placement[];
  /** By key; also elements and members of items: "jog.gains[2]", "slot:pose.position[0]". */
  item(key: string): Item | undefined;
  /** Of an arm, from base to tool; none of another device. */
  joints(device: string): readonly Joint[];
  /** What the tables placed there ("overview"), in their order; items that are hidden are left out. */
  placed(place: string): { readonly items: readonly Item[]; readonly placements: readonly Placement[] };
}

/** "longest_advance" → "Longest advance". */
export function labelOf(name: string): string {
  const words = name.replaceAll('_', ' ').trim();
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Column by column, as descriptor.json lists matrices, → rows. */
export function rowsOf(flat: readonly Value[], shape: readonly number[]): Value[] {
  const [rows, columns] = shape;
  if (rows === undefined || columns === undefined) return [...flat];
  return Array.from({ length: rows }, (_, row) =>
    Array.from({ length: columns }, (_unused, column) => flat[column * rows + row] ?? 0));
}

/** "axis/s^2" with { axis: "m" } → "m/s^2". */
export function unitWith(unit: string, chosen: { readonly [symbol: string]: string } | undefined): string {
  return chosen ? unit.replace(/[^*/^]+/g, (symbol) => chosen[symbol] ?? symbol) : unit;
}

interface Origin {
  readonly kind: ItemInfo['kind'];
  readonly component?: string;
  readonly source?: Source;
  readonly role?: Role;
  /** Of the arm that it is told of. */
  readonly joints?: readonly Joint[];
  /** Of the device's row. */
  readonly units?: { readonly [symbol: string]: string } | undefined;
  readonly absent?: string;
}

/** Beside a field: what its declaration says, and what the application's table changes of that. */
interface Declared {
  readonly parameter?: ParameterJson | undefined;
  readonly change?: OverrideJson | undefined;
}

/** One field as an item, with its members. */
function makeItem(types: Types, key: string, field: Field, path: string, origin: Origin, declared: Declared = {}): Item {
  const { parameter, change } = declared;
  const writable = origin.kind === 'runtime' || origin.kind === 'configuration';
  const role = writable ? (parameter?.role ?? origin.role ?? 'engineer') : undefined;
  const range = narrowed(parameter?.range, change?.range);
  const step = change?.step ?? parameter?.step;
  const flat = parameter?.default;
  const initial = Array.isArray(flat) && field.shape.length === 2 ? rowsOf(flat, field.shape) : flat;
  const type = field.typeName === undefined ? undefined : types.get(field.typeName);
  const members = type?.fields && field.shape.length === 0
    ? membersOf(types, key, type.fields, path, { ...origin, ...(role && { role }) })
    : undefined;
  const widget = change?.widget ?? parameter?.widget;
  const measured = measuredIn(field, origin.joints ?? []);
  return {
    key,
    label: change?.label ?? parameter?.label ?? labelOf(field.name),
    summary: field.summary,
    scalar: field.scalar,
    shape: field.shape,
    ...measured,
    unit: unitWith(measured.unit, origin.units),
    kind: origin.kind,
    hidden: change?.hidden ?? false,
    menu: change?.menu ?? parameter?.menu ?? '',
    place: change?.place ?? '',
    ...(range && { range }),
    ...(step !== undefined && { step }),
    ...(type?.values && { values: type.values }),
    ...(members && { members }),
    ...(field.typeName !== undefined && { typeName: field.typeName }),
    ...(role && { role }),
    ...(initial !== undefined && { default: initial }),
    ...(widget && { widget }),
    ...(change?.confirm && { confirm: change.confirm }),
    ...(origin.component !== undefined && { component: origin.component }),
    ...(parameter?.needs && { needs: needsOf(parameter.needs, origin.component ?? '') }),
    ...(writable && { path }),
    ...(origin.source && { source: origin.source }),
    ...(origin.absent !== undefined && { absent: origin.absent }),
  };
}

/** A unit "rad|m" is of joints that turn or slide: one for all of them where all are alike. */
function measuredIn(field: Field, joints: readonly Joint[]): Pick<ItemInfo, 'unit' | 'units'> {
  const [turning = '', sliding] = field.unit.split('|');
  if (sliding === undefined || joints.length === 0) return { unit: field.unit };
  const units = joints.map((joint) => (joint.unit === 'm' ? sliding : turning));
  const [first = field.unit] = units;
  return units.every((unit) => unit === first) ? { unit: first } : { unit: field.unit, units };
}

function needsOf(needs: NonNullable<ParameterJson['needs']>, component: string): NonNullable<ItemInfo['needs']> {
  return needs.map(({ of, field, numbers, reason }) => ({
    reason,
    ...(field !== undefined && { key: of === 'runtime' ? `${component}.${field}` : `${component}.feedback.${field}` }),
    ...(numbers && { numbers }),
  }));
}

/** `origin` is that of the structure; each member's source goes one step further. */
function membersOf(types: Types, key: string, fields: readonly Field[], path: string, origin: Origin): Item[] {
  return fields.map((field) => {
    const source = origin.source && deeper(origin.source, field);
    return makeItem(types, `${key}.${field.name}`, field, path ? `${path}.${field.name}` : field.name,
      { ...origin, ...(source && { source }) });
  });
}

function deeper(source: Source, field: Field): Source {
  return source.steps.length === 0
    ? { ...source, fields: [...source.fields, field] }
    : { ...source, steps: [...source.steps, field.name] };
}

/** The table may narrow a range, on one end or both. */
function narrowed(declared: readonly [number, number] | undefined,
                  change: readonly [number | null, number | null] | undefined): readonly [number, number] | undefined {
  const low = change?.[0] ?? declared?.[0];
  const high = change?.[1] ?? declared?.[1];
  return low === undefined || high === undefined ? undefined : [low, high];
}

/** An element of an array, as "gains[2]": made when asked for. */
function makeElement(types: Types, parent: Item, index: number): Item | undefined {
  const length = parent.shape[0];
  if (length === undefined || index >= length) return undefined;
  const { default: initial, ...rest } = parent;
  const key = `${parent.key}[${index}]`;
  const shape = parent.shape.slice(1);
  const path = parent.path === undefined ? undefined : `${parent.path}[${index}]`;
  const source = parent.source && { ...parent.source, steps: [...parent.source.steps, index] };
  const chosen = Array.isArray(initial) ? initial[index] : undefined;
  const fields = shape.length === 0 && parent.typeName !== undefined ? types.get(parent.typeName)?.fields : undefined;
  const members = fields && membersOf(types, key, fields, path ?? '', {
    kind: parent.kind,
    ...(parent.component !== undefined && { component: parent.component }),
    ...(parent.role && { role: parent.role }),
    ...(source && { source }),
    ...(parent.absent !== undefined && { absent: parent.absent }),
  });
  const { units, ...alike } = rest;
  return {
    ...alike, key, shape,
    unit: units?.[index] ?? parent.unit,
    label: `${parent.label} ${index + 1}`,
    ...(chosen !== undefined && { default: chosen }),
    ...(members && { members }),
    ...(path !== undefined && { path }),
    ...(source && { source }),
  };
}

/** `drivers`: of each device the one that it has; without it the first that its row permits. */
export function makeModel(json: DescriptorJson, drivers: Drivers = {}): Model {
  const types = makeTypes(json.types);
  const slots: Slot[] = [];
  const slotsByName = new Map<string, Slot>();
  const components = new Map<string, Component>();
  const items = new Map<string, Item>();
  const menus = new Map<string, Item[]>();

  const addAll = (item: Item): void => {
    items.set(item.key, item);
    item.members?.forEach((member) => addAll(member as Item));
  };

  const armOf = new Map<string, readonly Joint[]>(); // by slot, and by component
  for (const device of json.devices) {
    if (!device.joints) continue;
    armOf.set(`component:${device.name}`, device.joints);
    const outputs = [device, ...device.drivers].flatMap((one) => Object.values(one.outputs ?? {}).flat());
    for (const slot of [...outputs, device.feedback_slot]) if (typeof slot === 'string') armOf.set(slot, device.joints);
  }
  for (const unit of json.units) {
    const arms = Object.values(unit.devices ?? {}).flatMap((name) => {
      const joints = armOf.get(`component:${name}`);
      return joints ? [joints] : [];
    });
    const [joints] = arms;
    if (joints === undefined || arms.length > 1) continue; // of several arms: whose it is, nobody knows
    armOf.set(`component:${unit.name}`, joints);
    const outputs = Object.values(unit.outputs ?? {}).flat();
    for (const slot of [...outputs, unit.feedback_slot, unit.values_slot]) if (typeof slot === 'string') armOf.set(slot, joints);
  }

  const unitsOfSlots = new Map(json.devices.flatMap((device) =>
    [device.values_slot, device.feedback_slot].map((slot) => [slot, device.units] as const)));
  const driverOf = (device: DeviceJson): string => drivers[device.name] ?? device.drivers[0]?.driver ?? '';
  const driverOfSlots = new Map(json.devices.flatMap((device) =>
    [device.values_slot, device.feedback_slot].map((slot) => [slot, driverOf(device)] as const)));
  const useOf = slotUses(json, driverOf);
  json.slots.forEach((declared, index) => {
    const { writer, readers, unwritten } = useOf(declared);
    const slotJson = {
      ...declared, writer, readers, type: declared.driver_types?.[driverOfSlots.get(declared.name) ?? ''] ?? declared.type,
    };
    const type = types.get(slotJson.type);
    const slot = {
      index, name: slotJson.name, json: slotJson, image: type?.image ?? false, ...(unwritten !== undefined && { unwritten }),
    } as { -readonly [K in keyof Slot]: Slot[K] };
    const key = `slot:${slotJson.name}`;
    const source: Source = { slot, fields: [], steps: [] };
    const joints = armOf.get(slotJson.name);
    const members = membersOf(types, key, type?.fields ?? [], '',
      { kind: 'slot', source, units: unitsOfSlots.get(slotJson.name), ...(joints && { joints }) });
    slot.item = {
      key, label: slotJson.name, summary: slotJson.summary || (type?.summary ?? ''), scalar: 'structure', shape: [],
      unit: '', kind: 'slot', members, typeName: slotJson.type, hidden: false, menu: '', place: '',
      source,
    };
    slots.push(slot);
    slotsByName.set(slot.name, slot);
    addAll(slot.item);
  });

  const block = (component: string, kind: Origin['kind'], declared: BlockJson | undefined, slotName: string | undefined,
                 overrides: readonly OverrideJson[] | undefined,
                 values: { readonly [name: string]: Value } | undefined,
                 before: readonly (BlockJson | undefined)[] = [],
                 units?: { readonly [symbol: string]: string }, absent?: string): Item[] => {
    if (!declared) return [];
    const slot = slotName === undefined ? undefined : slotsByName.get(slotName);
    const joints = armOf.get(`component:${component}`);
    const prefix = kind === 'runtime' ? component : `${component}.${kind}`;
    const made: Item[] = [];
    for (const field of types.get(declared.type)?.fields ?? []) {
      const parameter = declared.parameters.find((one) => one.name === field.name);
      // Of several of one name the first is meant, in the order: runtime, configuration, feedback.
      const isMeant = !before.some((other) => other?.parameters.some((one) => one.name === field.name));
      const change = isMeant ? overrides?.find((one) => one.parameter === field.name) : undefined;
      const initial = values?.[field.name]; // the application's own default goes before the type's
      const merged = parameter && initial !== undefined ? { ...parameter, default: initial } : parameter;
      const item = makeItem(types, `${prefix}.${field.name}`, field, field.name,
        {
          kind, component, units, ...(joints && { joints }),
          ...(absent !== undefined ? { absent } : slot && { source: { slot, fields: [field], steps: [] } }),
        },
        { parameter: merged, change });
      // What belongs to a driver that is not there is known only where nothing that is there has its name.
      if (absent !== undefined && items.has(item.key)) continue;
      made.push(item);
      addAll(item);
      if (absent !== undefined) continue;
      // An interface's comes once with each driver.
      const others = (menus.get(item.menu) ?? []).filter((one) => one.key !== item.key);
      if (item.menu && !item.hidden) menus.set(item.menu, [...others, item]);
    }
    return made;
  };

  /** Runtime parameters and feedback that a device has; of those of other drivers it makes items that say so. */
  const deviceValues = (device: DeviceJson, face: InterfaceJson | undefined): Pick<Component, 'runtime' | 'feedback'> => {
    const has = driverOf(device);
    const made = (driver: string, absent?: string): Pick<Component, 'runtime' | 'feedback'> => {
      const choice = device.drivers.find((one) => one.driver === driver);
      const own = json.drivers.find((one) => one.name === choice?.type);
      const runtime = own?.runtime ?? face?.runtime;
      return {
        runtime: block(device.name, 'runtime', runtime, device.values_slot, device.overrides, { ...device.runtime, ...choice?.runtime },
          [], device.units, absent),
        feedback: block(device.name, 'feedback', own?.feedback ?? face?.feedback, device.feedback_slot, device.overrides, undefined,
          [runtime, face?.configuration, own?.configuration], device.units, absent),
      };
    };
    const values = made(has);
    for (const { driver } of device.drivers)
      if (driver !== has) made(driver, `the driver is '${has}'; this belongs to '${driver}'`);
    return values;
  };

  for (const unit of json.units) {
    const type = json.unit_types.find((one) => one.name === unit.type);
    components.set(unit.name, {
      kind: 'unit', name: unit.name, typeName: unit.type, summary: type?.summary ?? '', thread: unit.thread ?? '',
      population: unit.population ?? '', unit,
      driverConfiguration: new Map(),
      configuration: block(unit.name, 'configuration', type?.configuration, undefined, unit.overrides, unit.configuration,
        [type?.runtime]),
      runtime: block(unit.name, 'runtime', type?.runtime, unit.values_slot, unit.overrides, unit.runtime),
      feedback: block(unit.name, 'feedback', type?.feedback, unit.feedback_slot, unit.overrides, undefined,
        [type?.runtime, type?.configuration]),
    });
  }
  for (const device of json.devices) {
    const face = json.interfaces.find((one) => one.name === device.interface);
    // What it has comes last: where two drivers have a parameter of one name, the key is that of this one's.
    const has = driverOf(device);
    const inOrder = [...device.drivers.filter(({ driver }) => driver !== has), ...device.drivers.filter(({ driver }) => driver === has)];
    const driverConfiguration = new Map(inOrder.map((choice) => {
      const driver = json.drivers.find((one) => one.name === choice.type);
      const items = [face, driver].flatMap((declared) =>
        block(device.name, 'configuration', declared?.configuration, undefined, device.overrides, choice.configuration,
          [driver?.runtime ?? face?.runtime], device.units));
      return [choice.driver, items] as const;
    }));
    components.set(device.name, {
      kind: 'device', name: device.name, typeName: device.interface, summary: face?.summary ?? '',
      thread: device.thread ?? '', population: '', device,
      configuration: driverConfiguration.get(has) ?? [],
      driverConfiguration,
      ...deviceValues(device, face),
    });
  }

  const placements = (json.widgets ?? []).map((row): Placement => ({
    ...row, label: row.label ?? labelOf(row.name), place: row.place ?? 'overview',
    slots: row.slots ?? {}, parameters: row.parameters ?? {}, options: row.options ?? {},
  }));

  const find = (key: string): Item | undefined => {
    const known = items.get(key);
    if (known) return known;
    const element = /^(.+)\[(\d+)\]$/.exec(key);
    if (element) {
      const parent = find(element[1] ?? '');
      return parent && makeElement(types, parent, Number(element[2]));
    }
    const dot = key.lastIndexOf('.');
    const members = dot > 0 && key.includes('[') ? find(key.slice(0, dot))?.members : undefined;
    return members?.find((member) => member.key === key) as Item | undefined;
  };

  return {
    json, drivers, hash: json.hash, application: json.application, types, components, slots, slotsByName,
    queues: json.queues, threads: json.threads, menus, placements,
    item: find,
    joints: (device) => components.get(device)?.device?.joints ?? [],
    placed: (place) => ({
      items: [...items.values()].filter((item) => item.place === place && !item.hidden),
      placements: placements.filter((placement) => placement.place === place),
    }),
  };
}
