# Sourced by image_test.sh: GRUB's menu, as somebody at the PC's screen and keyboard finds it (docs/industrial-pc.md). Keys are QEMU's.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

# Of "only for this test", with few rounds: an emulated PC computes them.
menu_hash=grub.pbkdf2.sha512.1000.7E5D4FAFDB2098C8.5DB7F1F70FB7DB2EB871F501C918E88FB475C3B15FAD0C4FE17B445657CBC7C0

start_pc_at_screen() {  # start_pc_at_screen NAME DISK: what it writes is lost
  # shellcheck disable=SC2054 # the commas are QEMU's
  pc_disk=(-drive "file=${2//,/,,},format=raw,if=none,id=disk,snapshot=on" -device ide-hd,drive=disk)
  start_pc "$1" bios "$2" -no-reboot
}

press() {  # press KEY...: by QEMU's names
  local key
  for key; do
    printf 'sendkey %s\n' "$key" >&"$to_monitor"
    sleep 0.15
    while read -r -t 0.01 -n 4096 -u "$from_monitor"; do :; done # what QEMU says to it
  done
}

type_text() {  # type_text TEXT: and Enter
  local i key
  for ((i = 0; i < ${#1}; ++i)); do
    key=${1:i:1}
    press "${key/ /spc}"
  done
  press ret
}

menu='^   FlexRF, version A, whatever its marks'

refuses() {  # refuses KEY USER PASSWORD: what the key would do is asked a password for, and this is none
  press "$1" && await_screen '^Enter username:' && type_text "$2" && await_screen '^Enter password:' && type_text "$3" &&
    await_screen "$menu" && await_screen '^  \*FlexRF'
}

# Without the file that says what boots there is no shell either: the PC restarts.
grub_without_its_file_restarts() {
  local disk=$pc_folder/without.img
  need_claimed_pc && cp --sparse=always "$claimed/bios.img" "$disk" && mdel -i "$disk@@2M" ::grub/grub.cfg && start_pc_at_screen without "$disk" &&
    await_screen '^GRUB cannot read how this PC starts' && press esc c e || return
  while kill -0 "$pc_pid" 2>/dev/null; do
    (($(pc_seconds) <= pc_limit)) || { echo "the PC does not restart" && screen && return 1; }
    sleep 0.2
  done
}

# Nobody may edit an entry, get a command line, or choose another entry than the first, but who knows the password; and without one, nobody.
grubs_menu_wants_a_password() {
  need_claimed_pc && start_pc_at_screen menu "$claimed/bios.img" && await_screen "$menu" esc &&
    refuses e service 'a guess' && refuses c root 'only for this test' && press down && await_screen '^  \*FlexRF, version A' && press ret &&
    await_screen '^Enter username:' && type_text service && await_screen '^Enter password:' && type_text 'only for this test' &&
    await_line 'the cell runs' && log_in && await_machine '.slot == "A" and .boot == "manual"' || return
  stop_pc
  cp --sparse=always "$claimed/bios.img" "$pc_folder/locked.img" && mdel -i "$pc_folder/locked.img@@2M" ::grub/password.cfg &&
    start_pc_at_screen locked "$pc_folder/locked.img" && await_screen "$menu" esc && refuses c service 'only for this test'
}
