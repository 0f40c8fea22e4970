// Once per frame of the screen, for what need not be said more often; but said in any case: to a page that is hidden, or
// became so a moment ago, or whose screen stands still, no frame comes.

/** ms; two frames of a slow screen. */
export const longestWait = 100;

export function inNextFrame(act: () => void): void {
  const once = (): void => {
    cancelAnimationFrame(frame);
    clearTimeout(timer);
    act();
  };
  const frame = requestAnimationFrame(once);
  const timer = setTimeout(once, longestWait);
}
