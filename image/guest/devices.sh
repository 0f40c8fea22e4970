# Sourced by the guest's init: the devices that the tests find, as docs/guest.md lists them. prepare_devices is run before
# each test, and mends only what the one before took down.
# shellcheck shell=bash

gpio_lines=(ESTOP REED_OPEN REED_CLOSED VALVE_OPEN VALVE_CLOSE LAMP BUTTON SPARE)

prepare_link() {  # prepare_link NAME ARGUMENT...: brings the network interface up; ARGUMENTs are set while it is down
  local name=$1
  shift
  ip link show dev "$name" up 2>/dev/null | grep -q . && return
  if (($#)); then ip link set dev "$name" "$@"; fi
  ip link set dev "$name" up
}

prepare_gpio() {
  local chip=/sys/kernel/config/gpio-sim/chip line
  if [[ -d $chip ]]; then
    [[ $(<"$chip/live") == 1 ]] || echo 1 >"$chip/live"
    return
  fi
  mkdir -p "$chip/lines"
  echo "${#gpio_lines[@]}" >"$chip/lines/num_lines"
  echo flexrf-sim >"$chip/lines/label"
  for line in "${!gpio_lines[@]}"; do
    mkdir "$chip/lines/line$line"
    echo "${gpio_lines[line]}" >"$chip/lines/line$line/name"
  done
  echo 1 >"$chip/live"
}

prepare_lines() {  # serial lines whose driver was taken from them
  local port
  for port in /sys/bus/pnp/devices/*; do
    [[ $(<"$port/id") == PNP0501* && ! -e $port/driver ]] && echo "${port##*/}" >/sys/bus/pnp/drivers/serial/bind
  done
}

prepare_devices() {
  prepare_link lo
  prepare_lines
  [[ -e /sys/class/net/vcan0 ]] || ip link add dev vcan0 type vcan
  prepare_link vcan0
  prepare_link can0 type can bitrate 500000
  prepare_link can1 type can bitrate 500000
  prepare_gpio
}
