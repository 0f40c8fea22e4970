// The widgets that change something or draw: a chunk of its own, loaded when the first of them is shown.
import type { RegisterWidget } from '../contract';
import { loadPart } from '../core/parts';
import type { LoadWidget } from '../core/registry';
import { RobotWidget } from './robot/robot_widget';
import { ArrayField } from './array_field';
import { Button } from './button';
import { Gauge } from './gauge';
import { Histogram } from './histogram';
import { HoldButton } from './hold_button';
import { ImageView } from './image';
import { JogPad } from './jog_pad';
import { NumberField } from './number_field';
import { Pose2d } from './pose_2d';
import { Select } from './select';
import { Slider } from './slider';
import { TextField } from './text_field';
import { Toggle } from './toggle';

/** Kinds that few applications show: each is loaded by itself. */
const apart = new Map<string, () => ReturnType<LoadWidget>>([
  ['population', async () => (await import('./population')).Population],
  ['timeline', async () => (await import('./timeline')).Timeline],
]);

export function registerFurther(register: RegisterWidget): LoadWidget {
  register('image', ImageView);
  register('histogram', Histogram);
  register('gauge', Gauge);
  register('pose_2d', Pose2d);
  register('button', Button);
  register('hold', HoldButton);
  register('toggle', Toggle);
  register('slider', Slider);
  register('number_field', NumberField);
  register('select', Select);
  register('text_field', TextField);
  register('array_field', ArrayField);
  register('jog_pad', JogPad);
  register('robot', RobotWidget);
  return async (kind) => {
    const load = apart.get(kind);
    return load && loadPart(load);
  };
}
