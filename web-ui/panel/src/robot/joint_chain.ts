// The moving joints of a URDF in the order in which slots carry their positions: from the base to the tool.

export interface ChainJoint {
  readonly name: string;
  /** Turns (rad) or slides (m). */
  readonly unit: 'rad' | 'm';
  /** undefined: it turns for ever. */
  readonly limits: readonly [number, number] | undefined;
}

/** Throws with the cause when the text is no robot. */
export function jointChain(urdf: string): ChainJoint[] {
  const document = new DOMParser().parseFromString(urdf, 'text/xml');
  const broken = document.querySelector('parsererror');
  if (broken) throw new Error('The URDF is not well-formed XML.');
  const robot = document.documentElement;
  if (robot.nodeName !== 'robot') throw new Error(`The URDF begins with <${robot.nodeName}>, not with <robot>.`);

  const joints = [...robot.children].filter((element) => element.nodeName === 'joint');
  const linkOf = (joint: Element, end: 'parent' | 'child'): string => joint.querySelector(`:scope > ${end}`)?.getAttribute('link') ?? '';
  const children = new Set(joints.map((joint) => linkOf(joint, 'child')));
  const roots = [...robot.children]
    .filter((element) => element.nodeName === 'link')
    .map((link) => link.getAttribute('name') ?? '')
    .filter((name) => !children.has(name));

  const chain: ChainJoint[] = [];
  const seen = new Set<Element>();
  const follow = (link: string): void => {
    for (const joint of joints) {
      if (linkOf(joint, 'parent') !== link || seen.has(joint)) continue;
      seen.add(joint);
      const moving = movingJoint(joint);
      if (moving) chain.push(moving);
      follow(linkOf(joint, 'child'));
    }
  };
  roots.forEach(follow);
  return chain;
}

/** Joints that are fixed, or follow another, have no position of their own. */
function movingJoint(joint: Element): ChainJoint | undefined {
  const type = joint.getAttribute('type');
  if (type !== 'revolute' && type !== 'continuous' && type !== 'prismatic') return undefined;
  if (joint.querySelector(':scope > mimic')) return undefined;
  const limit = joint.querySelector(':scope > limit');
  const bound = (name: string): number => Number(limit?.getAttribute(name) ?? Number.NaN);
  const limits = [bound('lower'), bound('upper')] as const;
  return {
    name: joint.getAttribute('name') ?? '',
    unit: type === 'prismatic' ? 'm' : 'rad',
    limits: type !== 'continuous' && limits.every(Number.isFinite) ? limits : undefined,
  };
}
