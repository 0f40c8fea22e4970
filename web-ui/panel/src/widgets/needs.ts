// What commands need, as their tables say: watched, so that a button is dead, and says why, while it could do nothing.
import type { ItemInfo, Reading, Value, WidgetHost } from '../contract';

export class Needs {
  readonly #values = new Map<string, Value | null>();
  readonly #endings: (() => void)[];

  /** Calls back when the answer of unmet() may be another. */
  constructor(private readonly host: WidgetHost, items: readonly ItemInfo[], changed: () => void) {
    const keys = new Set(items.flatMap((item) => (item.needs ?? []).flatMap((need) => need.key ?? [])));
    this.#endings = [...keys].map((key) => host.watch(key, (reading: Reading) => {
      if (this.#values.get(key) === reading.value) return;
      this.#values.set(key, reading.value);
      changed();
    }, { rate: 10 }));
  }

  /** The reason of the first need that is not met; empty: all are, as far as is known. Motion is the host's to judge. */
  unmet(item: ItemInfo): string {
    return item.needs?.find((need) => {
      if (need.key === undefined) return false;
      const value = this.#values.get(need.key);
      if (value === undefined) return false; // the first has not come yet; the application judges in any case
      const number = typeof value === 'string' ? this.host.item(need.key)?.values?.indexOf(value) : Number(value);
      return value === null || number === undefined || !need.numbers?.includes(number);
    })?.reason ?? '';
  }

  end(): void {
    this.#endings.splice(0).forEach((ending) => ending());
  }
}
