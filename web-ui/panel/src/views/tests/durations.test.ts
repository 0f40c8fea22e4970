// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { ageText, countdownText, countText, durationText, rateText } from '../durations';

describe('durationText', () => {
  it.each([
    [0, '0'],
    [1, '1 ns'],
    [850, '850 ns'],
    [999.9, '1.00 µs'],
    [12_345, '12.3 µs'],
    [999_960, '1.00 ms'],
    [1_200_000, '1.20 ms'],
    [150_000_000, '150 ms'],
    [75_000_000_000, '75.0 s'],
    [-2_500, '-2.50 µs'],
    [Number.NaN, '–'],
  ])('%d ns', (nanoseconds, text) => expect(durationText(nanoseconds)).toBe(text));
});

describe('ageText', () => {
  it.each([
    [0.05, 'now'],
    [0.44, '0.4 s'],
    [12.4, '12 s'],
    [200, '3 min'],
    [7300, '2 h'],
    [Number.POSITIVE_INFINITY, '–'],
  ])('%d s', (seconds, text) => expect(ageText(seconds)).toBe(text));
});

it('counts down in minutes and seconds, and not below zero', () => {
  expect(countdownText(300)).toBe('5:00');
  expect(countdownText(246.2)).toBe('4:07');
  expect(countdownText(-3)).toBe('0:00');
});

it('shows rates with the digits that mean something', () => {
  expect(rateText(null)).toBe('–');
  expect(rateText(0)).toBe('0 /s');
  expect(rateText(142.86)).toBe('143 /s');
  expect(rateText(0.5)).toBe('0.50 /s');
});

it('sets thousands apart', () => {
  expect(countText(7)).toBe('7');
  expect(countText(1234567)).toBe('1\u202f234\u202f567');
});
