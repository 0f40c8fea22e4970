// How kinds of things are told apart: by a colour and by dashes, for who does not see the colour.

export interface Stroke {
  readonly colour: string;
  /** stroke-dasharray, px; empty: a line without gaps. */
  readonly dashes: string;
}

// After Okabe and Ito (2008), lightened where needed: on the dark seam that each line has all are seen in any picture.
const colours = ['#56b4e9', '#e69f00', '#f0e442', '#3fd0a4', '#ff8a5c', '#e39cc8', '#ffffff', '#9fb4ff'];
const dashes = ['', '9 4', '9 3 2 3', '2 3'];

/** Different for the first 32 kinds. */
export function strokeOf(kind: number): Stroke {
  const round = Math.floor(kind / colours.length);
  return { colour: colours[kind % colours.length]!, dashes: dashes[(kind + round) % dashes.length]! };
}

/** Behind lines and texts. */
export const seam = '#14181c';
