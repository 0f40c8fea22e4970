import { describe, expect, it } from 'vitest';
import { makeModel } from '../../core/descriptor';
import { sample } from '../../core/tests/sample';
import { chosenFeedback } from '../overview';

describe('the overview without anything placed', () => {
  it('shows feedback that is not hidden', () => {
    const keys = chosenFeedback(makeModel(sample)).map((item) => item.key);
    expect(keys).toEqual(['mode', 'note', 'moving', 'offset'].map((name) => `jog.feedback.${name}`));
  });
  it('gives each component its first values before any gets its last', () => {
    const units = Array.from({ length: 10 }, (_, index) => ({ ...sample.units[0]!, name: `jog_${index}` }));
    const keys = chosenFeedback(makeModel({ ...sample, units })).map((item) => item.key);
    expect(keys).toHaveLength(24);
    expect(units.every((unit) => keys.includes(`${unit.name}.feedback.mode`))).toBe(true);
    expect(keys.indexOf('jog_0.feedback.note')).toBe(keys.indexOf('jog_0.feedback.mode') + 1);
  });
});
