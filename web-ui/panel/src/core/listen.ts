// Listening that ends.

/** Until the returned function is called. */
export function listen(target: EventTarget, name: string, listener: (event: never) => void, capture = false): () => void {
  target.addEventListener(name, listener as EventListener, capture);
  return () => target.removeEventListener(name, listener as EventListener, capture);
}
