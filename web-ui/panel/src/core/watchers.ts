// Who wants to be told or found, kept in sets.

/** It is one of them until the returned function is called. */
export function added<Watcher>(all: Set<Watcher>, watcher: Watcher): () => void {
  all.add(watcher);
  return () => all.delete(watcher);
}
