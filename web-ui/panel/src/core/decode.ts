// Binary frames of values: little-endian, as docs/panel-protocol.md has them. Decodes only what is asked for.
import type { Value } from '../contract';
import { rowsOf } from './descriptor';
import type { Field, Type, Types } from './types';

const messageHeader = 32;
const itemHeader = 32;
const high = 4294967296;

/** Newest item of one slot, as it came. */
export interface FrameItem {
  /** Index in descriptor.json's "slots". */
  readonly slot: number;
  /** Of the value; empty: NULL. Keeps the whole message alive. */
  readonly bytes: DataView;
  readonly sequence: number;
  readonly sampledAt: number;
  /** Number in the null_reasons of hello; 0: there is a value. */
  readonly reason: number;
  readonly jpeg: boolean;
  /** By how much a JPEG was scaled down. */
  readonly scaledBy: number;
  /** Items that this connection never saw since its last frame with this slot. */
  readonly missed: number;
}

export interface Frame {
  /** The descriptor's hash, 16 hexadecimal digits. */
  readonly hash: string;
  readonly serverTime: number;
  readonly dropped: number;
  readonly number: number;
  readonly items: readonly FrameItem[];
}

/** Above 2^53 it is the nearest double: good to a microsecond for a time, for centuries. */
export function readU64(view: DataView, at: number): number {
  return view.getUint32(at + 4, true) * high + view.getUint32(at, true);
}
export function readI64(view: DataView, at: number): number {
  return view.getInt32(at + 4, true) * high + view.getUint32(at, true);
}

/** undefined: it is no such frame, and nothing of it is used. */
export function decodeFrame(buffer: ArrayBuffer): Frame | undefined {
  if (buffer.byteLength < messageHeader) return undefined;
  const view = new DataView(buffer);
  const hex = (at: number): string => view.getUint32(at, true).toString(16).padStart(8, '0');
  const count = view.getUint32(16, true);
  const items: FrameItem[] = [];
  let at = messageHeader;
  for (let index = 0; index < count; index += 1) {
    if (at + itemHeader > buffer.byteLength) return undefined;
    const size = view.getUint32(at + 4, true);
    const value = at + itemHeader;
    if (size > buffer.byteLength - value) return undefined;
    items.push({
      slot: view.getUint32(at, true),
      bytes: new DataView(buffer, value, size),
      sequence: readU64(view, at + 8),
      sampledAt: readI64(view, at + 16),
      reason: view.getUint8(at + 24),
      jpeg: view.getUint8(at + 25) === 1,
      scaledBy: view.getUint16(at + 26, true),
      missed: view.getUint32(at + 28, true),
    });
    at = value + Math.ceil(size / 8) * 8;
  }
  return {
    hash: hex(4) + hex(0),
    serverTime: readI64(view, 8),
    dropped: view.getUint32(20, true),
    number: readU64(view, 24),
    items,
  };
}

const text = new TextDecoder();

function decodeText(view: DataView, at: number, capacity: number): string {
  const bytes = new Uint8Array(view.buffer, view.byteOffset + at, capacity);
  const end = bytes.indexOf(0);
  return text.decode(end < 0 ? bytes : bytes.subarray(0, end));
}

function decodeUnsigned(view: DataView, at: number, size: number): number {
  if (size === 8) return readU64(view, at);
  if (size === 4) return view.getUint32(at, true);
  return size === 2 ? view.getUint16(at, true) : view.getUint8(at);
}

function decodeElement(view: DataView, at: number, field: Field, types: Types): Value {
  switch (field.scalar) {
    case 'bool': return view.getUint8(at) !== 0;
    case 'i8': return view.getInt8(at);
    case 'u8': return view.getUint8(at);
    case 'i16': return view.getInt16(at, true);
    case 'u16': return view.getUint16(at, true);
    case 'i32': return view.getInt32(at, true);
    case 'u32': return view.getUint32(at, true);
    case 'i64': return readI64(view, at);
    case 'u64': return readU64(view, at);
    case 'f32': return view.getFloat32(at, true);
    case 'f64': return view.getFloat64(at, true);
    case 'text': return decodeText(view, at, field.elementSize);
    case 'enumeration': {
      const number = view.getUint8(at);
      return types.get(field.typeName ?? '')?.values?.[number] ?? number;
    }
    case 'button': return decodeUnsigned(view, at, field.elementSize);
    case 'hold': return decodeUnsigned(view, at, field.elementSize) !== 0;
    case 'structure': {
      const type = types.get(field.typeName ?? '');
      return type ? decodeStructure(view, at, type, types) : {};
    }
  }
}

/** A field of a structure that begins at `base`. Arrays are flat, matrices lists of rows. */
export function decodeField(view: DataView, base: number, field: Field, types: Types): Value {
  const at = base + field.offset;
  if (field.shape.length === 0) return decodeElement(view, at, field, types);
  const flat: Value[] = [];
  for (let index = 0; index < field.count; index += 1) {
    flat.push(decodeElement(view, at + index * field.elementSize, field, types));
  }
  return field.shape.length === 2 ? rowsOf(flat, field.shape) : flat;
}

export function decodeStructure(view: DataView, base: number, type: Type, types: Types): { [field: string]: Value } {
  const value: { [field: string]: Value } = {};
  for (const field of type.fields ?? []) value[field.name] = decodeField(view, base, field, types);
  return value;
}
