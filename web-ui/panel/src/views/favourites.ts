// Items that a person marked, kept on this computer for each application.

export class Favourites {
  #keys: Set<string>;
  readonly #place: string;

  constructor(application: string, private readonly storage: Storage = localStorage) {
    this.#place = `flexrf.favourites.${application}`;
    let kept: unknown;
    try {
      kept = JSON.parse(storage.getItem(this.#place) ?? '[]');
    } catch {
      kept = []; // somebody else's
    }
    this.#keys = new Set(Array.isArray(kept) ? kept.filter((key) => typeof key === 'string') : []);
  }

  has(key: string): boolean {
    return this.#keys.has(key);
  }

  toggle(key: string): void {
    if (!this.#keys.delete(key)) this.#keys.add(key);
    this.storage.setItem(this.#place, JSON.stringify([...this.#keys]));
  }
}
