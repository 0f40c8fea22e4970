// What is said or asked of a control lies over what is beside it, so that nothing moves under a finger.

/** The composed ancestor that scrolls the views, or else the window. */
function viewOf(element: Element): { left: number; top: number; right: number; bottom: number } {
  for (let at: Node | null = element; at; ) {
    if (at instanceof HTMLElement && at.localName === 'main') return at.getBoundingClientRect();
    at = at instanceof ShadowRoot ? at.host : ((at as Element).assignedSlot ?? at.parentNode);
  }
  return { left: 0, top: 0, right: window.innerWidth, bottom: window.innerHeight };
}

const margin = 4;

/** Below its control, or above where there is no room; never beyond the sides of what is seen. */
export function placeOver(over: HTMLElement): void {
  over.style.translate = '';
  over.classList.remove('above');
  const view = viewOf(over);
  if (over.getBoundingClientRect().bottom > view.bottom) {
    over.classList.add('above');
    if (over.getBoundingClientRect().top < view.top) over.classList.remove('above');
  }
  const box = over.getBoundingClientRect();
  const left = Math.max(view.left + margin, Math.min(box.left, view.right - margin - box.width));
  if (left !== box.left) over.style.translate = `${Math.round(left - box.left)}px`;
}
