// What a person looks for: all of some words, in any order and case.

export function wordsOf(wanted: string): string[] {
  return wanted.toLowerCase().split(/\s+/).filter((word) => word !== '');
}

export function hasAll(text: string, words: readonly string[]): boolean {
  const lower = text.toLowerCase();
  return words.every((word) => lower.includes(word));
}
