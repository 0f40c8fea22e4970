// Processes that a test started, by their ids.
import { readFileSync, readdirSync } from 'node:fs';

interface Running {
  readonly id: number;
  readonly parent: number;
}

function running(): Running[] {
  return readdirSync('/proc').flatMap((name) => {
    if (!/^\d+$/.test(name)) return [];
    try {
      const text = readFileSync(`/proc/${name}/stat`, 'utf8');
      const fields = text.slice(text.lastIndexOf(')') + 2).split(' ');
      return [{ id: Number(name), parent: Number(fields[1]) }];
    } catch {
      return []; // it ended meanwhile
    }
  });
}

/** The process and all that it started. */
export function familyOf(id: number): number[] {
  const all = running();
  const family = [id];
  for (const member of family) family.push(...all.filter((one) => one.parent === member).map((one) => one.id));
  return family;
}

export function signal(processes: readonly number[], name: NodeJS.Signals): void {
  for (const id of processes) {
    try {
      process.kill(id, name);
    } catch {
      // It ended meanwhile.
    }
  }
}

/** Resident memory, bytes. */
export function residentMemory(id: number): number {
  const pages = Number(readFileSync(`/proc/${id}/statm`, 'utf8').split(' ')[1]);
  return pages * 4096;
}
