// The layout of plain structs: descriptor.json's "types", made ready for decoding.
import type { Scalar } from '../contract';
import type { TypeJson } from './descriptor_json';

export interface Field {
  readonly name: string;
  readonly scalar: Scalar;
  readonly typeName?: string;
  readonly shape: readonly number[];
  /** Bytes from the start of the struct. */
  readonly offset: number;
  /** Bytes of one element. */
  readonly elementSize: number;
  /** Elements: 1 without a shape. */
  readonly count: number;
  readonly unit: string;
  readonly summary: string;
}

export interface Type {
  readonly name: string;
  readonly summary: string;
  readonly size: number;
  readonly image: boolean;
  /** Of a structure. */
  readonly fields?: readonly Field[];
  /** Names of an enumeration, in order. */
  readonly values?: readonly string[];
}

export type Types = ReadonlyMap<string, Type>;

export function makeTypes(list: readonly TypeJson[]): Types {
  const types = new Map<string, Type>();
  for (const json of list) {
    types.set(json.name, {
      name: json.name,
      summary: json.summary,
      size: json.size ?? 1,
      image: json.image ?? false,
      ...(json.values && { values: json.values.map((value) => value.name) }),
      ...(json.fields && {
        fields: json.fields.map((field): Field => {
          const shape = field.shape ?? [];
          const count = shape.reduce((product, extent) => product * extent, 1);
          return {
            name: field.name,
            scalar: (field.scalar === 'boolean' ? 'bool' : field.scalar) as Scalar,
            shape,
            offset: field.offset,
            elementSize: count === 0 ? 0 : field.size / count,
            count,
            unit: field.unit ?? '',
            summary: field.summary,
            ...(field.type !== undefined && { typeName: field.type }),
          };
        }),
      }),
    });
  }
  return types;
}
