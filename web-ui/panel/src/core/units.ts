// SI inside, the person's units on display. Values are converted where they are shown and where they are typed in,
// and nowhere else.
import { added } from './watchers';

export interface DisplayUnit {
  /** As shown beside a number: "mm", "°", "" for dimensionless. */
  readonly text: string;
  /** Displayed = SI * factor. */
  readonly factor: number;
}

const plain: { readonly [unit: string]: string } = {
  '1': '', 'm^2': 'm²', 'm^3': 'm³', 'm/s^2': 'm/s²', 'm/s^3': 'm/s³', 'rad/s^2': 'rad/s²', 'rad/s^3': 'rad/s³',
  'N*m': 'N·m', 'kg*m^2': 'kg·m²', us: 'µs', degC: '°C', ohm: 'Ω',
};

const degrees = 180 / Math.PI;
const workshop: { readonly [unit: string]: DisplayUnit } = {
  m: { text: 'mm', factor: 1000 },
  'm/s': { text: 'mm/s', factor: 1000 },
  'm/s^2': { text: 'mm/s²', factor: 1000 },
  'm/s^3': { text: 'mm/s³', factor: 1000 },
  rad: { text: '°', factor: degrees },
  'rad/s': { text: '°/s', factor: degrees },
  'rad/s^2': { text: '°/s²', factor: degrees },
  'rad/s^3': { text: '°/s³', factor: degrees },
  Pa: { text: 'kPa', factor: 1e-3 },
};

const place = 'flexrf.units';

export class DisplayUnits {
  #si: boolean;
  #watchers = new Set<() => void>();

  /** `storage` keeps the choice on this computer; undefined where there is none. */
  constructor(private readonly storage?: Storage) {
    this.#si = storage?.getItem(place) === 'si';
  }

  /** Whether everything is shown in SI. */
  get si(): boolean { return this.#si; }
  set si(value: boolean) {
    if (value === this.#si) return;
    this.#si = value;
    this.storage?.setItem(place, value ? 'si' : 'workshop');
    this.#watchers.forEach((watcher) => watcher());
  }

  /** Calls back when another choice was made. Ends with the returned function. */
  watch(callback: () => void): () => void {
    return added(this.#watchers, callback);
  }

  of(unit: string): DisplayUnit {
    const [turning, sliding] = unit.split('|'); // of joints that differ
    if (sliding !== undefined) return { text: `${turning} or ${sliding}`, factor: 1 };
    return (this.#si ? undefined : workshop[unit]) ?? { text: plain[unit] ?? unit, factor: 1 };
  }
  toDisplay(value: number, unit: string): number { return value * this.of(unit).factor; }
  fromDisplay(value: number, unit: string): number { return value / this.of(unit).factor; }
}

/** The units of this page. */
export const displayUnits = new DisplayUnits(typeof localStorage === 'undefined' ? undefined : localStorage);

/** A number that nothing is known of: at most so many significant digits, and none that it does not need. */
export function significantText(value: number, digits: number): string {
  return String(Number(value.toPrecision(digits))).replaceAll('-', '−');
}
