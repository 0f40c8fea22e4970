// All widgets that come with the panel, in one chunk of their own.
import type { RegisterWidget } from '../contract';
import { RobotWidget } from '../robot/robot_widget';
import { ArrayField } from './array_field';
import { ArrayReadout } from './array_readout';
import { Button } from './button';
import { Gauge } from './gauge';
import { Histogram } from './histogram';
import { HoldButton } from './hold_button';
import { ImageView } from './image';
import { JogPad } from './jog_pad';
import { Lamp } from './lamp';
import { NumberField } from './number_field';
import { NumberReadout } from './number_readout';
import { Pose2d } from './pose_2d';
import { Records } from './records';
import { Select } from './select';
import { Slider } from './slider';
import { Structure } from './structure';
import { TextField } from './text_field';
import { EnumerationReadout, TextReadout } from './text_readout';
import { Toggle } from './toggle';

export { kindOf } from './choose';

export function registerBuiltIn(register: RegisterWidget): void {
  register('number', NumberReadout);
  register('vector', ArrayReadout);
  register('matrix', class extends ArrayReadout {}); // an element class has one name
  register('lamp', Lamp);
  register('enumeration', EnumerationReadout);
  register('text', TextReadout);
  register('image', ImageView);
  register('histogram', Histogram);
  register('gauge', Gauge);
  register('pose_2d', Pose2d);
  register('structure', Structure);
  register('records', Records);
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
}
