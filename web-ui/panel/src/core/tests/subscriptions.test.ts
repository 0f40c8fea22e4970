// @vitest-environment node
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { longestMessage, Subscriptions } from '../subscriptions';

const request = vi.fn();
const onSlotGone = vi.fn();
const onProblem = vi.fn();
let subscriptions: Subscriptions;

beforeEach(() => {
  vi.useFakeTimers();
  [onSlotGone, onProblem].forEach((mock) => mock.mockReset());
  request.mockReset().mockResolvedValue({ id: 1, ok: true, unknown: [] });
  subscriptions = new Subscriptions({ request, onSlotGone, onProblem });
});
afterEach(() => vi.useRealTimers());

describe('subscriptions', () => {
  it('are asked for together, each slot once at its highest rate and width', () => {
    subscriptions.addSlot('joints', 10);
    subscriptions.addSlot('joints', 100);
    subscriptions.addSlot('camera', 15, 320);
    subscriptions.addSlot('camera', 5, 640);
    subscriptions.addTopic('threads', 20);
    vi.advanceTimersByTime(50);
    expect(request).toHaveBeenCalledOnce();
    expect(request).toHaveBeenCalledWith('subscribe', {
      slots: [{ name: 'joints', rate: 60 }, { name: 'camera', rate: 15, width: 640 }],
      topics: [{ name: 'threads', rate: 10 }],
    });
  });
  it('end with the last who wanted them', () => {
    const ends = [subscriptions.addSlot('joints', 10), subscriptions.addSlot('joints', 30)];
    vi.advanceTimersByTime(50);
    ends[1]?.();
    ends[1]?.();
    vi.advanceTimersByTime(50);
    expect(request).toHaveBeenLastCalledWith('subscribe', { slots: [{ name: 'joints', rate: 10 }], topics: [] });
    expect(onSlotGone).not.toHaveBeenCalled();
    ends[0]?.();
    vi.advanceTimersByTime(50);
    expect(request).toHaveBeenLastCalledWith('subscribe', { slots: [], topics: [] });
    expect(onSlotGone).toHaveBeenCalledExactlyOnceWith('joints');
  });
  it('are not repeated when nothing changed, but are on a new connection', () => {
    subscriptions.addSlot('joints', 10);
    vi.advanceTimersByTime(50);
    subscriptions.addSlot('joints', 5);
    vi.advanceTimersByTime(50);
    expect(request).toHaveBeenCalledOnce();
    subscriptions.resubscribe();
    expect(request).toHaveBeenCalledTimes(2);
  });
  it('never make a message that the server refuses', () => {
    for (let index = 0; index < 2000; index += 1) subscriptions.addSlot(`a_rather_long_name_of_a_slot_${index}`, 10);
    vi.advanceTimersByTime(50);
    const fields = request.mock.calls[0]?.[1] as { slots: unknown[] };
    expect(JSON.stringify(fields).length).toBeLessThanOrEqual(longestMessage);
    expect(fields.slots.length).toBeGreaterThan(100);
    expect(onProblem).toHaveBeenCalledOnce();
  });
  it('tell of names that the application does not know', async () => {
    request.mockResolvedValue({ id: 1, ok: true, unknown: ['gone'] });
    subscriptions.addSlot('gone', 1);
    await vi.advanceTimersByTimeAsync(50);
    expect(onProblem).toHaveBeenCalledWith(expect.stringContaining('gone'));
  });
});
