# Sourced by image_test.sh: what an admin does to an industrial PC from a browser, as requests of its panel (docs/panel-protocol.md): what
# the PC tells, another address, and an update from the upload to its confirmation. The application, the helper, RAUC and the boot loader
# are the product's.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

make_product_update() (  # a bundle with another version, of what the claimed PC runs, which says that its camera has another driver
  work=$pc_folder/product
  rm -rf "$work"
  mkdir -p "$work/identity" && take_partition "$claimed/bios.img" root-a "$work/packed" && take_partition "$claimed/bios.img" boot-a "$work/boot.img" &&
    unsquashfs -q -n -d "$work/root" "$work/packed" >/dev/null &&
    sed -i '/^drivers=/s/camera=simulated/camera=v4l2/' "$work/root/usr/lib/flexrf/version" && cp "$work/root/usr/lib/flexrf/version" "$work/identity/" &&
    version_of_test pack_changed "$work" second "$pc_folder/second.raucb" && rm -rf "$work"
)

machine() { ask_panel api/v1/machine -b "$pc_folder/cookies" >"$pc_folder/machine.json" && jq -r "$1" "$pc_folder/machine.json"; } # machine FILTER: of what the PC tells

# ask_machine STATUS WHAT [MEMBERS]: a change that an admin asks for, with the password; the answer has to have this status. Where a host
# that does much else gives the PC no time, the answer may be late: then it is asked again, and may have been done meanwhile.
ask_machine() {
  local wanted=$1 what=$2 status late=''
  for _ in 1 2 3; do
    status=$(ask_panel "api/v1/machine/$what" --retry 0 -b "$pc_folder/cookies" -o "$pc_folder/answer.json" -w '%{http_code}' -X POST \
      -H 'Content-Type: application/json' -d "$(jq -n '{password: "only for this test"} + ($ARGS.positional[0] | fromjson)' --args "${3-{\}}")")
    [[ $status == "$wanted" || ($late && $status == 409) ]] && return
    [[ $status == 503 && $(<"$pc_folder/answer.json") == *"does not answer in time"* ]] || break
    late=yes
  done
  printf '%s was answered %s: %s\n' "$what" "$status" "$(<"$pc_folder/answer.json")"
  return 1
}

await_machine() {  # await_machine FILTER: until it is true of what the PC tells
  local said
  until said=$(machine "$1") && [[ $said == true ]]; do
    if ! kill -0 "$pc_pid" 2>/dev/null || (($(pc_seconds) > pc_limit)); then
      printf 'the PC never told: %s; but: %s\n' "$1" "$(<"$pc_folder/machine.json")"
      return 1
    fi
    # A cell that was started anew, as where this machine had no time for it, knows nobody any more.
    [[ $(jq .status "$pc_folder/machine.json") != 401 ]] || log_in || return
    sleep 0.5
  done
}

# The other port leads to the address that is set here: the panel is reached there, and not where it was.
another_address_is_kept() {
  local first_port=$pc_port
  ask_machine 400 network '{"interface": "can0", "address": "dhcp"}' &&
    ask_machine 400 network '{"interface": "enp0s2", "address": "10.0.2.16"}' &&
    await_machine '.network[0] | .interface == "enp0s2" and .link and .addresses == ["10.0.2.15/24"] and .setting == "image"' &&
    ask_machine 200 network '{"interface": "enp0s2", "address": "10.0.2.16/24", "gateway": "10.0.2.2"}' &&
    await_line 'motion is not permitted: the address of enp0s2 is on trial' && await_line 'addresses of this PC: enp0s2 10.0.2.16/24$' || return
  pc_port=$((first_port + 1))
  await_machine '.network[0].addresses == ["10.0.2.16/24"] and .network_trial.interface == "enp0s2"' && ask_machine 200 keep-network &&
    await_machine '.network_trial.interface == "" and .motion == "permitted"' || return
  ! curl -s -k --max-time 5 -o "$pc_folder/nobody" "https://localhost:$first_port/" || { echo "the panel is still at its first address" && return 1; }
}

# Parts of 60 KiB, as the panel's page sends them; one after the other, as each has to follow what is there.
send_bundle() {  # send_bundle FILE
  local token part offset=0 status
  ask_machine 200 upload "{\"size\": $(stat -c %s "$1")}" && token=$(jq -r .upload "$pc_folder/answer.json") || return
  rm -rf "$pc_folder/parts" && mkdir "$pc_folder/parts" && split -b 60K -a 4 "$1" "$pc_folder/parts/" || return
  for part in "$pc_folder/parts/"*; do
    printf '%s\n' next silent show-error insecure 'max-time = 60' 'request = PUT' 'header = "Content-Type: application/octet-stream"' \
      'write-out = "%{http_code}\n"' "cookie = $pc_folder/cookies" "output = $pc_folder/answer.json" "data-binary = \"@$part\"" \
      "url = https://localhost:$pc_port/api/v1/machine/bundle?upload=$token&offset=$offset"
    offset=$((offset + $(stat -c %s "$part")))
  done | sed 1d >"$pc_folder/parts.curl"
  status=$(curl -K "$pc_folder/parts.curl" | sort | uniq -c)
  rm -rf "$pc_folder/parts"
  [[ $status =~ ^\ *[0-9]+\ 200$ ]] || { printf 'the parts were answered: %s; the last: %s\n' "$status" "$(<"$pc_folder/answer.json")" && return 1; }
}

# By UEFI, from where second_boot_by_uefi has left the PC. What is sent is installed while the cell rests, and starts on trial; the address that
# was kept is that of the new version, too.
an_admin_at_the_panel() {
  local pc_limit=1500 uefi
  need_claimed_pc && make_product_update && once uefi second_boot_by_uefi && uefi=$(kept uefi) &&
    cp --sparse=always "$uefi/uefi.img" "$pc_folder/admin.img" && cp "$uefi/uefi.variables" "$pc_folder/admin.variables" &&
    restore_pc "$uefi/uefi.memory" admin uefi "$pc_folder/admin.img" && log_in &&
    await_machine '.version == "first" and .slot == "A" and .boot == "confirmed" and .development_key' && another_address_is_kept &&
    send_bundle "$pc_folder/second.raucb" && await_machine '.update.phase == "verified" and .update.version == "second" and (.update.older | not)' &&
    await_machine '.update.driver_changes == [{"device": "camera", "from": "simulated", "to": "v4l2"}] and (.drivers | contains("camera=simulated"))' &&
    ask_machine 409 install && ask_machine 200 install '{"other_drivers": true}' && await_machine '.update.phase == "installed"' &&
    await_machine '.motion == "an update was installed: the PC has to be restarted" and .slots.B.whole and .slots.B.primary' &&
    ask_machine 200 restart && await_line 'the version in slot B has confirmed itself' && log_in &&
    await_machine '.version == "second" and .slot == "B" and .boot == "trial" and .confirmed and .slots.A.version == "first"' &&
    await_machine '.network[0] | .addresses == ["10.0.2.16/24"] and .setting == "fixed"'
}
