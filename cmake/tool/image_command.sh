# Sourced by flexrf: the command `image`.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

# shellcheck source=cmake/tool/image.sh
source "$tool/image.sh"

check_version() {
  [[ ! $image_version || $image_version =~ ^[A-Za-z0-9][A-Za-z0-9._+-]{0,63}$ ]] ||
    misuse image "--version: '$image_version' is no name of a version; up to 64 letters, digits, dots and dashes are, as 2026.11-rc1"
}

check_combination() {  # check_combination KIND: of the options for keys
  [[ ${image_key:+1} == "${image_certificate:+1}" ]] || misuse image "--key and --certificate belong together"
  if [[ $1 == bundle ]]; then
    [[ ! $image_key || $image_keyring ]] ||
      misuse image "--keyring is missing: which CA the PC trusts from this version on (--new-keys makes one, ca.pem)"
    [[ ! $image_keyring || $image_key ]] || misuse image "a bundle is signed: --keyring needs --key and --certificate"
    [[ ! $image_boot_password ]] || misuse image "--boot-password-hash is for a disk: updates leave GRUB as it is"
  else
    [[ ! $image_key ]] || misuse image "--key and --certificate sign a bundle: with --bundle; a disk's image is not signed, and --keyring says whom it trusts"
  fi
}

image_command() {
  local application='' output='' obstacle variant=product kind=image suffix keys_folder='' signer_folder=''
  local -A place=([--key]=image_key [--certificate]=image_certificate [--keyring]=image_keyring [--version]=image_version
    [--boot-password-hash]=image_boot_password [--output]=output [--new-keys]=keys_folder [--new-signer]=signer_folder)
  while (($#)); do
    case $1 in
      --output | --key | --certificate | --keyring)
        [[ ${2-} ]] || misuse image "$1 needs the name of a file"
        printf -v "${place[$1]}" %s "$2"
        shift
        ;;
      --version | --boot-password-hash | --new-keys | --new-signer)
        [[ ${2-} ]] || misuse image "$1 needs a value"
        printf -v "${place[$1]}" %s "$2"
        shift
        ;;
      --bundle) kind=bundle ;;
      --test-devices) variant='test' ;;
      --) break ;;
      -*) unknown_option image "$1" --bundle "${!place[@]}" --test-devices --help ;;
      *)
        [[ $application ]] && misuse image "unexpected '$1' (the application's own arguments come after --)"
        application=$1
        ;;
    esac
    shift
  done
  [[ ${1-} == -- ]] && shift
  if [[ $keys_folder ]]; then
    [[ ! $application && $kind == image && ! $output ]] || misuse image "--new-keys DIR stands alone"
    install_packages image
    new_keys "$keys_folder"
    return
  fi
  if [[ $signer_folder ]]; then
    [[ ! $application && $kind == image && ! $output ]] || misuse image "--new-signer DIR stands alone"
    install_packages image
    new_signer "$signer_folder"
    return
  fi
  [[ $application ]] || misuse image "it takes the name of one application"
  need_application "$application"
  check_version
  check_combination "$kind"
  boot_password "$application" >/dev/null || exit 1
  obstacle=$(image_obstacle)
  [[ $obstacle ]] && die "there can be no image on this machine: $obstacle"
  check_room
  suffix=img
  if [[ $kind == bundle ]]; then suffix=raucb; fi
  [[ $output || $variant == product ]] || output=$image_folder/$application-test.$suffix
  output=${output:-$image_folder/$application.$suffix}
  check_output "$output"
  if [[ $variant == test ]]; then install_packages build image guest; else install_packages build image; fi
  choose_keys
  build release "$application" flexrf-boot-choice flexrf-claim flexrf-helper flexrf-screen || exit 1
  "make_$kind" "$application" "$output" "$variant" "$@"
  [[ $kind == bundle ]] || say "next, with the PC's disk plugged in here: ./flexrf flash $(printf %q "$output")"
}
