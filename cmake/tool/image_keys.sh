# Sourced by image.sh: whose updates a PC takes. A CA signs the certificates of those who sign updates; its own certificate is in the
# image, the keyring. Without keys of one's own there is one for development.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

key_years=20 # nobody is there who would renew what a PC trusts

make_certificate() {  # make_certificate NAME SUBJECT EXTENSION... [-- OPTION OF OPENSSL...]: NAME.key and NAME.pem, of its own or a CA's
  local name=$1 subject=$2 extensions=''
  shift 2
  while (($#)) && [[ $1 != -- ]]; do
    extensions+=$1$'\n'
    shift
  done
  openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days $((key_years * 365)) -subj "/CN=$subject" \
    -config <(printf '[req]\ndistinguished_name=name\nx509_extensions=extensions\n[name]\n[extensions]\n%s' "$extensions") \
    -keyout "$name.key" -out "$name.pem" "${@:2}"
}

make_keys() {  # make_keys FOLDER WHOSE
  local said
  said=$(
    umask 077
    cd "$1" &&
      make_certificate ca "$2: CA of updates" basicConstraints=critical,CA:TRUE keyUsage=critical,keyCertSign subjectKeyIdentifier=hash 2>&1 &&
      make_certificate signer "$2: signer of updates" basicConstraints=critical,CA:FALSE keyUsage=critical,digitalSignature \
        extendedKeyUsage=critical,codeSigning authorityKeyIdentifier=keyid -- -CA ca.pem -CAkey ca.key 2>&1 &&
      chmod 644 ca.pem signer.pem
  ) || { say "$said" && return 1; }
}

new_keys() {  # new_keys FOLDER
  local folder file
  folder=$(readlink -m "$1")
  [[ $folder/ != "$root"/* ]] || die "$folder is in the repository, and keys would get into it: name a folder elsewhere"
  for file in ca.key ca.pem signer.key signer.pem; do
    [[ ! -e $folder/$file ]] || die "$folder has a $file already, which nobody could make again: name another folder"
  done
  (umask 077 && mkdir -p "$folder" 2>/dev/null && [[ -w $folder ]]) ||
    die "there can be no keys in $folder: name a folder that can be made and written"
  make_keys "$folder" FlexRF || die "the keys could not be made"
  cat >&2 <<TEXT
flexrf: in $folder are now
  ca.key      makes further signers. Keep it where no network reaches, and a copy of it elsewhere: it cannot be made again
  ca.pem      what PCs trust, for all to see: --keyring $folder/ca.pem, for images and bundles
  signer.key  signs updates. Who has it can make one for each of these PCs: keep it where bundles are made, and nowhere else
  signer.pem  its certificate: --key $folder/signer.key --certificate $folder/signer.pem
Both end in $key_years years.
TEXT
}

development_keys() {  # prints their folder; makes them once
  local folder=${cache:-${XDG_CACHE_HOME:-${HOME:+$HOME/.cache}}/flexrf}/development-key made
  [[ $folder != /flexrf/* ]] || { say "there is no home to keep a development key in: give --keyring, and --key and --certificate" && return 1; }
  if [[ ! -e $folder/signer.pem ]]; then
    mkdir -p "${folder%/*}" && made=$(mktemp -d "$folder.XXXXXX") && make_keys "$made" 'FlexRF development' || return
    # Who else made one meanwhile was first.
    mv -T "$made" "$folder" 2>/dev/null || rm -rf "$made"
  fi
  printf '%s\n' "$folder"
}

check_keys() {  # check_keys KEY CERTIFICATE KEYRING: ends with a message if updates so signed are none that the keyring trusts
  local said
  [[ $(openssl pkey -in "$1" -pubout 2>&1) == "$(openssl x509 -in "$2" -noout -pubkey 2>&1)" ]] ||
    die "the certificate $2 is not that of the key $1"
  said=$(openssl verify -CAfile "$3" -purpose any "$2" 2>&1) ||
    die "a PC with the keyring $3 would not trust the certificate $2: $(sed -n 's/^error .*: //p' <<<"$said" | head -n 1)"
  [[ $(openssl x509 -in "$2" -noout -ext extendedKeyUsage 2>/dev/null) == *'Code Signing'* ]] ||
    die "the certificate $2 is not one for signing code (extendedKeyUsage=codeSigning), which PCs ask for"
}

# Sets image_key, image_certificate and image_keyring where they were not given, and development_key to yes or no.
choose_keys() {
  local folder option file
  for option in key certificate keyring; do
    file=image_$option
    [[ ! ${!file-} || -r ${!file} ]] || die "--$option: there is no file ${!file} that can be read"
  done
  if [[ ${image_keyring-} ]]; then
    openssl x509 -in "$image_keyring" -noout 2>/dev/null || die "--keyring: $image_keyring is no certificate (PEM); ./flexrf image --new-keys DIR makes one"
  fi
  development_key=no
  if [[ ! ${image_keyring-} ]]; then
    folder=$(development_keys) || exit 1
    image_key=$folder/signer.key image_certificate=$folder/signer.pem image_keyring=$folder/ca.pem
    development_key=yes
    say "WARNING: the development key is what this PC trusts ($folder): anyone who has it can make an update for this PC."
    say "For a PC that is in use: ./flexrf image --new-keys DIR, and --keyring"
  elif openssl x509 -in "$image_keyring" -noout -subject | grep -q 'FlexRF development'; then
    development_key=yes
    say "WARNING: the keyring is that of a development key: anyone who has that can make an update for this PC."
  fi
  if [[ ${image_key-} ]]; then check_keys "$image_key" "$image_certificate" "$image_keyring"; fi
}
