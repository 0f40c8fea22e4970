# Sourced by flexrf: the command `flash`, which writes an image to a PC's disk.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

# shellcheck source=cmake/tool/flash_image.sh
source "$tool/flash_image.sh"
# shellcheck source=cmake/tool/flash_disks.sh
source "$tool/flash_disks.sh"

on_terminal() { [[ -t 0 && -t 2 ]]; } # somebody can be asked

choose_disk() {  # choose_disk FILE: asks for one of those that can be written, and takes it
  local answer path
  local -a offered
  list_disks "$1"
  ((${#offered[@]})) || die "there is no disk that can be written. Plug the PC's disk in, as by an adapter for USB"
  on_terminal || die "which disk is written, a person chooses at a terminal; a script names it: ./flexrf flash FILE DEVICE --yes"
  read -r -p "Which one? Its number or name, Enter for none: " answer || answer=''
  [[ $answer ]] || die "no disk was chosen, and nothing was written"
  for path in "${offered[@]}"; do
    if [[ $answer == "$path" || $answer == "${path##*/}" ]]; then answer=$path; fi
  done
  if [[ $answer =~ ^[1-9][0-9]{0,3}$ ]] && ((answer <= ${#offered[@]})); then answer=${offered[answer - 1]}; fi
  [[ " ${offered[*]} " == *" $answer "* ]] || die "'$answer' is none of these disks, and nothing was written"
  take_disk "$answer"
}

become_root() {  # become_root ARGUMENT...: the command anew, by root
  local words how=()
  words=$(printf ' %q' "$root/flexrf" flash "$@")
  if ! command -v sudo >/dev/null; then
    say "writing a disk needs root, and there is no sudo here. As root:$words"
    exit 3
  fi
  say "writing a disk needs root: sudo$words"
  # Where nobody can type a password, sudo does not wait for one.
  on_terminal || how=(-n)
  exec sudo "${how[@]}" "$root/flexrf" flash "$@"
}

flash_command() {
  local file='' device='' confirm=ask
  local -a given=("$@")
  while (($#)); do
    case $1 in
      --yes) confirm=yes ;;
      -*) unknown_option flash "$1" --yes --help ;;
      *)
        [[ ! $device ]] || misuse flash "unexpected '$1'"
        if [[ $file ]]; then device=$1; else file=$1; fi
        ;;
    esac
    shift
  done
  [[ $file ]] || misuse flash "it takes the file of an image, as build/image/APP.img"
  [[ $confirm == ask || $device ]] || misuse flash "--yes asks nothing: it needs the disk's name behind the file"
  check_file "$file"
  [[ ! $device || $confirm == yes ]] || on_terminal ||
    die "what is on the disk is lost, and without a terminal nobody can say that it may be: in a script, --yes says so"
  install_packages flash
  check_image "$file"
  look_at_disks
  # All that may be refused is refused before root is asked for.
  if [[ $device ]]; then
    find_disk "$device" "$file"
  elif ! on_terminal; then
    choose_disk "$file"
  fi
  if [[ $(id -u) != 0 ]]; then become_root "${given[@]}"; fi
  if [[ ! $device ]]; then choose_disk "$file"; fi
  exec perl "$tool/disk.pl" hold "$disk_path" bash "$tool/flash_write.sh" "$file" "$disk_path" "$confirm"
}
