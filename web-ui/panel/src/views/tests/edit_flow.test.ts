// @vitest-environment node
import { beforeEach, describe, expect, it } from 'vitest';
import type { ApplyAnswer, BeginAnswer, Change, EditLink } from '../edit_flow';
import { EditFlow } from '../edit_flow';

const begun: BeginAnswer = {
  ok: true,
  edit: 'e1',
  reinitialised: ['robot', 'arm'],
  configuration: { arm: { servo_lag: 0.012, noise: 2e-5 }, robot: { longest_advance: 0.02, gains: [1, 2] } },
};

/** A server whose answers the test gives when it likes. */
class Server implements EditLink {
  begins: ((answer: BeginAnswer) => void)[] = [];
  applies: ((answer: ApplyAnswer) => void)[] = [];
  asked: readonly string[] = [];
  sent: readonly Change[] = [];
  discarded: string[] = [];
  begin(components: readonly string[]): Promise<BeginAnswer> {
    this.asked = components;
    return new Promise((resolve) => this.begins.push(resolve));
  }
  apply(_edit: string, changes: readonly Change[]): Promise<ApplyAnswer> {
    this.sent = changes;
    return new Promise((resolve) => this.applies.push(resolve));
  }
  discard(edit: string): void {
    this.discarded.push(edit);
  }
}

let server: Server;
let flow: EditFlow;
let time: number;
let renders: number;

beforeEach(() => {
  server = new Server();
  time = 1000;
  renders = 0;
  flow = new EditFlow({
    link: server,
    check: (_component, parameter, value) => (parameter === 'noise' && Number(value) > 0.01 ? 'noise: too large' : ''),
    now: () => time,
    changed: () => ++renders,
  });
});

async function opened(): Promise<void> {
  const opening = flow.open(['arm']);
  server.begins.shift()!(begun);
  await opening;
}

describe('Edit', () => {
  it('opens with what will be initialised again', async () => {
    const opening = flow.open(['arm']);
    expect(flow.state.step).toBe('opening');
    server.begins.shift()!(begun);
    await opening;
    expect(server.asked).toEqual(['arm']);
    expect(flow.state.step).toBe('editing');
    expect(flow.draft?.reinitialised).toEqual(['robot', 'arm']);
    expect(flow.left).toBe(300_000);
  });

  it('says what moves when it is denied, and can be asked again', async () => {
    const opening = flow.open(['arm']);
    server.begins.shift()!({ ok: false, detail: 'robot moves', moving: ['robot'] });
    await opening;
    expect(flow.state).toMatchObject({ step: 'denied', moving: ['robot'], components: ['arm'] });
    await opened();
    expect(flow.state.step).toBe('editing');
  });

  it('gives back what it gets after the person thought better of it', async () => {
    const opening = flow.open(['arm']);
    flow.discard();
    server.begins.shift()!(begun);
    await opening;
    expect(flow.state.step).toBe('closed');
    expect(server.discarded).toEqual(['e1']);
  });

  it('is one at a time', async () => {
    await opened();
    void flow.open(['robot']);
    expect(server.begins).toHaveLength(0);
    expect(server.asked).toEqual(['arm']);
  });
});

describe('editing', () => {
  beforeEach(opened);

  it('marks what differs, and no more when it is set back', () => {
    flow.change('arm', 'servo_lag', 0.02);
    expect(flow.isChanged('arm', 'servo_lag')).toBe(true);
    expect(flow.value('arm', 'servo_lag')).toBe(0.02);
    flow.change('arm', 'servo_lag', 0.012);
    expect(flow.isChanged('arm', 'servo_lag')).toBe(false);
    expect(flow.changes).toEqual([]);
  });

  it('keeps zero, false and empty texts as values', () => {
    flow.change('arm', 'servo_lag', 0);
    expect(flow.isChanged('arm', 'servo_lag')).toBe(true);
    expect(flow.value('arm', 'servo_lag')).toBe(0);
  });

  it('compares arrays by their elements', () => {
    flow.change('robot', 'gains', [1, 2]);
    expect(flow.changes).toEqual([]);
    flow.change('robot', 'gains', [1, 3]);
    expect(flow.changes).toEqual([{ component: 'robot', values: { gains: [1, 3] } }]);
    flow.revert('robot', 'gains');
    expect(flow.changes).toEqual([]);
  });

  it('knows no other parameters', () => {
    flow.change('arm', 'colour', 3);
    flow.change('camera', 'gain', 3);
    expect(flow.changes).toEqual([]);
  });

  it('does not apply nothing, nor what is out of range', () => {
    expect(flow.cannotApply).toBe('nothing was changed');
    flow.change('arm', 'noise', 5);
    expect(flow.cannotApply).toBe('noise: too large');
    void flow.apply();
    expect(server.applies).toHaveLength(0);
    flow.revert('arm', 'noise');
    flow.change('arm', 'servo_lag', 0.1);
    expect(flow.cannotApply).toBe('');
  });
});

describe('Apply', () => {
  beforeEach(async () => {
    await opened();
    flow.change('arm', 'servo_lag', 0.1);
    flow.change('robot', 'longest_advance', 0.05);
  });

  async function apply(answer: ApplyAnswer): Promise<void> {
    const applying = flow.apply();
    server.applies.shift()!(answer);
    await applying;
  }

  it('sends all changes together', async () => {
    await apply({ ok: true, outcome: 'done', causes: [], owners: ['robot', 'arm'] });
    expect(server.sent).toEqual([
      { component: 'arm', values: { servo_lag: 0.1 } },
      { component: 'robot', values: { longest_advance: 0.05 } },
    ]);
    expect(flow.state).toEqual({ step: 'applied', outcome: 'done', causes: [], owners: ['robot', 'arm'] });
  });

  it('stays open with its values when they are refused', async () => {
    await apply({ ok: true, outcome: 'refused', causes: ['servo_lag: too slow'], owners: [] });
    expect(flow.state.step).toBe('editing');
    expect(flow.draft).toMatchObject({ failure: 'refused', causes: ['servo_lag: too slow'] });
    expect(flow.value('arm', 'servo_lag')).toBe(0.1);
    flow.change('arm', 'servo_lag', 0.05);
    expect(flow.draft?.causes).toEqual([]);
  });

  it('stays open to be corrected when all was rolled back', async () => {
    await apply({ ok: true, outcome: 'rolled_back', causes: ['arm: no answer'], owners: ['robot', 'arm'] });
    expect(flow.state.step).toBe('editing');
    expect(flow.draft).toMatchObject({ failure: 'rolled_back', causes: ['arm: no answer'] });
    flow.discard();
    expect(server.discarded).toEqual(['e1']);
  });

  it('ends with a fault and its causes', async () => {
    await apply({ ok: true, outcome: 'fault', causes: ['arm: no answer'], owners: ['robot', 'arm'] });
    expect(flow.state).toMatchObject({ step: 'applied', outcome: 'fault', causes: ['arm: no answer'] });
    flow.discard();
    expect(flow.state.step).toBe('closed');
    expect(server.discarded).toEqual([]);
  });

  it('stays open when the request itself failed', async () => {
    await apply({ ok: false, detail: 'no answer' });
    expect(flow.state.step).toBe('editing');
    expect(flow.draft?.causes).toEqual(['no answer']);
  });

  it('is not discarded halfway', async () => {
    const applying = flow.apply();
    flow.discard();
    flow.serverSays('nobody');
    expect(flow.state.step).toBe('applying');
    server.applies.shift()!({ ok: true, outcome: 'done', causes: [], owners: [] });
    await applying;
    expect(flow.state.step).toBe('applied');
  });
});

describe('the end of an edit', () => {
  beforeEach(opened);

  it('is Discard', () => {
    flow.discard();
    expect(flow.state.step).toBe('closed');
    expect(server.discarded).toEqual(['e1']);
  });

  it('is five minutes', () => {
    time += 299_999;
    flow.tick();
    expect(flow.state.step).toBe('editing');
    time += 1;
    flow.tick();
    expect(flow.state.step).toBe('ended');
  });

  it('comes when the server says, which counts anew after each Apply', () => {
    time += 299_000;
    flow.serverSays('you', 250_000);
    expect(flow.left).toBe(250_000);
    time += 1000;
    flow.tick();
    expect(flow.state.step).toBe('editing');
  });

  it('is the server, once it had said that this session edits', () => {
    flow.serverSays('nobody');
    expect(flow.state.step).toBe('editing');
    flow.serverSays('you');
    flow.serverSays('nobody');
    expect(flow.state.step).toBe('ended');
    flow.discard();
    expect(flow.state.step).toBe('closed');
  });

  it("is another's edit", () => {
    flow.serverSays('other');
    expect(flow.state).toMatchObject({ step: 'ended', reason: expect.stringContaining('Another session') as string });
  });
});

it('tells of every change', async () => {
  await opened();
  const before = renders;
  flow.change('arm', 'servo_lag', 0.1);
  expect(renders).toBe(before + 1);
});
