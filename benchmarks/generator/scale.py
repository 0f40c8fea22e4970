#!/usr/bin/env python3
"""scale.py FOLDER UNITS SLOTS_PER_UNIT: writes an application with many units of few types, to measure generator and
compiler with. FOLDER becomes: types/, units/, scale.toml, CMakeLists.txt."""
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
units = int(sys.argv[2])
outputs = int(sys.argv[3])
kinds = 5


def write(path, text):
    path = folder / path
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


for kind in range(kinds):
    write(f"types/item_{kind}.toml", f'''summary = "What units of kind {kind} pass on."
[field.value]
type = "f64"
shape = [{kind + 1}]
unit = "m"
summary = "A value."
[field.count]
type = "u32"
summary = "A count."
''')
    ports = "".join(f'''
[output.out_{k}]
type = "Item{kind}"
summary = "Output {k}."
''' for k in range(outputs))
    write(f"units/stage_{kind}/stage_{kind}.toml", f'''summary = "A stage of kind {kind}."

[input.in]
type = "Item{(kind + kinds - 1) % kinds}"
summary = "From the stage before."
{ports}
[configuration.offset]
type = "f64"
unit = "m"
default = 0.5
summary = "Added to the value."

[runtime.gain]
type = "f64"
unit = "1"
range = [0.0, 10.0]
default = 1.0
summary = "Multiplies the value."

[feedback.steps]
type = "u64"
summary = "Steps so far."
''')
    publish = "\n".join(f"    out_{k}.publish(item);" for k in range(outputs))
    write(f"units/stage_{kind}/stage_{kind}.hpp", f'''#pragma once
#include "stage_{kind}_unit.hpp"

namespace flexrf {{

class Stage{kind} final : public Stage{kind}Unit {{
 public:
  void step(const Tick&) override {{
    Item{kind} item{{}};
    if (const auto before = in.latest()) item.count = before->count + 1;
    item.value[0] = configuration.offset * runtime.gain;
{publish}
    ++feedback.steps;
  }}
}};

}}  // namespace flexrf
''')

rows = ['summary = "Many units of few types."', 'memory_budget = "64 MiB"', ""]
for unit in range(units):
    before = (unit - 1) % units
    rows += [f"[unit.u{unit}]", f'type = "stage_{unit % kinds}"', f'in.in = "s{before}_0"']
    rows += [f'out.out_{k} = "s{unit}_{k}"' for k in range(outputs)]
    rows += ["budget = \"1 us\"", ""]
names = ", ".join(f'"u{unit}"' for unit in range(units))
rows += ["[thread.control]", 'trigger = { period = "10 ms" }', "priority = 40", 'role = "control"', f"units = [{names}]"]
write("scale.toml", "\n".join(rows) + "\n")
write("CMakeLists.txt", "flexrf_add_application(NAME scale)\n")
