// Options of a row [widget.NAME] that hold several names: "first, second".
import type { Placement } from '../contract';

export function namesIn(options: Placement['options'], option: string): string[] {
  const text = options[option];
  return typeof text === 'string' ? text.split(',').map((name) => name.trim()).filter((name) => name !== '') : [];
}

export function nameIn(options: Placement['options'], option: string): string | undefined {
  return namesIn(options, option)[0];
}
