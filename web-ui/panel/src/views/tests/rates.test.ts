// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { RateMeter, RateMeters } from '../rates';

describe('RateMeter', () => {
  it('knows nothing of one sample', () => {
    const meter = new RateMeter();
    expect(meter.rate).toBeNull();
    meter.add(5, 1);
    expect(meter.rate).toBeNull();
  });

  it('divides by the time between first and last', () => {
    const meter = new RateMeter(10);
    meter.add(0, 0);
    meter.add(10, 1);
    meter.add(40, 2);
    expect(meter.rate).toBe(20);
  });

  it('forgets what is older than its window', () => {
    const meter = new RateMeter(2);
    meter.add(0, 0);
    meter.add(1000, 1);
    for (let second = 2; second <= 6; ++second) meter.add(1000 + second, second);
    expect(meter.rate).toBe(1);
  });

  it('keeps two samples however far apart', () => {
    const meter = new RateMeter(1);
    meter.add(0, 0);
    meter.add(30, 10);
    expect(meter.rate).toBe(3);
  });

  it('begins anew when the counter falls: another application', () => {
    const meter = new RateMeter();
    meter.add(100, 1);
    meter.add(200, 2);
    meter.add(3, 3);
    expect(meter.rate).toBeNull();
    meter.add(7, 4);
    expect(meter.rate).toBe(4);
  });

  it('takes the later of two samples of one time', () => {
    const meter = new RateMeter();
    meter.add(0, 0);
    meter.add(1, 1);
    meter.add(2, 1);
    expect(meter.rate).toBe(2);
  });
});

describe('RateMeters', () => {
  it('tells names apart and forgets them all', () => {
    const meters = new RateMeters();
    expect(meters.add('a', 0, 0)).toBeNull();
    expect(meters.add('b', 0, 0)).toBeNull();
    expect(meters.add('a', 2, 1)).toBe(2);
    expect(meters.add('b', 5, 1)).toBe(5);
    meters.forget();
    expect(meters.add('a', 4, 2)).toBeNull();
  });
});
