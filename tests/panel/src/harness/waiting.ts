// How tests wait: for what they want to see, never for a time.

/** Ends a test that waits for something that never comes. A busy machine does not exceed it. */
export const within = 120_000;

/** Looks until there is something; throws what `complaint` says when nothing comes. */
export async function until<Found>(look: () => Found | undefined | Promise<Found | undefined>, complaint: () => string): Promise<Found> {
  const giveUp = performance.now() + within;
  for (;;) {
    const found = await look();
    if (found !== undefined) return found;
    if (performance.now() > giveUp) throw new Error(complaint());
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}
