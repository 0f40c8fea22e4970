import { describe, expect, it } from 'vitest';
import { jointChain } from '../joint_chain';

const joint = (name: string, type: string, parent: string, child: string, more = ''): string =>
  `<joint name="${name}" type="${type}"><parent link="${parent}"/><child link="${child}"/>${more}</joint>`;
const links = (...names: string[]): string => names.map((name) => `<link name="${name}"/>`).join('');

describe('jointChain', () => {
  it('goes from the base to the tool, whatever the order in the file', () => {
    const urdf = `<robot name="r">${links('tool', 'base', 'b', 'a')}
      ${joint('second', 'prismatic', 'a', 'b', '<limit lower="0" upper="0.5"/>')}
      ${joint('mount', 'fixed', 'b', 'tool')}
      ${joint('first', 'revolute', 'base', 'a', '<limit lower="-1" upper="2"/>')}</robot>`;
    expect(jointChain(urdf)).toEqual([
      { name: 'first', unit: 'rad', limits: [-1, 2] },
      { name: 'second', unit: 'm', limits: [0, 0.5] },
    ]);
  });

  it('leaves out what follows another, and knows joints without limits', () => {
    const urdf = `<robot name="r">${links('base', 'a', 'b')}
      ${joint('turn', 'continuous', 'base', 'a', '<limit velocity="1"/>')}
      ${joint('echo', 'revolute', 'a', 'b', '<mimic joint="turn"/>')}</robot>`;
    expect(jointChain(urdf)).toEqual([{ name: 'turn', unit: 'rad', limits: undefined }]);
  });

  it('ends on a loop', () => {
    const urdf = `<robot name="r">${links('base', 'a', 'b')}
      ${joint('one', 'continuous', 'base', 'a')}${joint('two', 'continuous', 'a', 'b')}${joint('back', 'continuous', 'b', 'a')}</robot>`;
    expect(jointChain(urdf).map((one) => one.name)).toEqual(['one', 'two', 'back']);
  });

  it('says what is wrong', () => {
    expect(() => jointChain('<robot')).toThrow('well-formed');
    expect(() => jointChain('<model/>')).toThrow('<model>');
  });
});
