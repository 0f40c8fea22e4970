// What a person chose for this computer: theme and size of controls. Units are kept by core/units.ts.

export type Theme = 'system' | 'light' | 'dark';
export type Touch = 'system' | 'large';

const themePlace = 'flexrf.theme';
const touchPlace = 'flexrf.touch';

export class Preferences {
  constructor(private readonly root: HTMLElement, private readonly storage: Storage, private readonly dark: MediaQueryList) {
    dark.addEventListener('change', () => this.#apply());
    this.#apply();
  }

  get theme(): Theme {
    const kept = this.storage.getItem(themePlace);
    return kept === 'light' || kept === 'dark' ? kept : 'system';
  }
  set theme(theme: Theme) {
    this.storage.setItem(themePlace, theme);
    this.#apply();
  }

  get touch(): Touch {
    return this.storage.getItem(touchPlace) === 'large' ? 'large' : 'system';
  }
  set touch(touch: Touch) {
    this.storage.setItem(touchPlace, touch);
    this.#apply();
  }

  #apply(): void {
    const { theme } = this;
    this.root.dataset['theme'] = theme === 'system' ? (this.dark.matches ? 'dark' : 'light') : theme;
    this.root.dataset['touch'] = this.touch;
  }
}
