# Sourced by image.sh: whose updates a PC takes. A CA signs the certificates of those who sign updates; its own certificate is in the
# image, the keyring, which may have those of several CAs. Without keys of one's own there is one for development.
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

make_signer() {  # make_signer NAME WHOSE: with ca.key, in the folder of now
  make_certificate "$1" "$2: signer of updates" basicConstraints=critical,CA:FALSE keyUsage=critical,digitalSignature \
    extendedKeyUsage=critical,codeSigning authorityKeyIdentifier=keyid -- -CA ca.pem -CAkey ca.key && chmod 644 "$1.pem"
}

make_keys() {  # make_keys FOLDER WHOSE
  local said
  said=$(
    umask 077
    cd "$1" && {
      make_certificate ca "$2: CA of updates" basicConstraints=critical,CA:TRUE keyUsage=critical,keyCertSign subjectKeyIdentifier=hash &&
        chmod 644 ca.pem && make_signer signer "$2"
    } 2>&1
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

# new_signer FOLDER: another one of the CA there, for somebody else or in the place of one that was lost. PCs go on to trust the others
new_signer() {
  local folder said number=2
  folder=$(readlink -m "$1")
  [[ -r $folder/ca.key && -r $folder/ca.pem ]] || die "$folder has no ca.key and ca.pem: a signer is made where the CA is; ./flexrf image --new-keys DIR makes one"
  while [[ -e $folder/signer-$number.key || -e $folder/signer-$number.pem ]]; do number=$((number + 1)); done
  said=$(umask 077 && cd "$folder" && make_signer "signer-$number" FlexRF 2>&1) || { say "$said" && die "the signer could not be made"; }
  say "another signer of this CA: --key $folder/signer-$number.key --certificate $folder/signer-$number.pem"
  say "The others are trusted as before. If one was stolen: docs/industrial-pc.md, A key that was stolen"
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
    die "a PC with the keyring $3 would not trust the certificate $2: $(sed -n 's/^error .*: //p' <<<"$said" | head -n 1)." \
      "To change the CA, give both first: docs/industrial-pc.md, Another CA"
  [[ $(openssl x509 -in "$2" -noout -ext extendedKeyUsage 2>/dev/null) == *'Code Signing'* ]] ||
    die "the certificate $2 is not one for signing code (extendedKeyUsage=codeSigning), which PCs ask for"
}

subjects_of_keyring() {  # of each certificate in it; fails if it has none
  openssl crl2pkcs7 -nocrl -certfile "$image_keyring" 2>/dev/null | openssl pkcs7 -print_certs -noout 2>/dev/null | sed -n 's/^subject= *//p' | grep .
}

check_keyring() {  # ends with a message if it is none, or has what no PC looks at
  ! grep -q 'PRIVATE KEY' "$image_keyring" ||
    die "--keyring: $image_keyring has a private key in it, which everybody could read in the image: leave the certificate alone there"
  ! grep -q 'X509 CRL' "$image_keyring" ||
    die "--keyring: $image_keyring has a list of revoked certificates, which PCs do not look at. After a theft change the CA: docs/industrial-pc.md, A key that was stolen"
  subjects_of_keyring >/dev/null || die "--keyring: $image_keyring is no certificate (PEM); ./flexrf image --new-keys DIR makes one"
}

# Sets image_key, image_certificate and image_keyring where they were not given, and development_key to yes or no.
choose_keys() {
  local folder option file
  for option in key certificate keyring; do
    file=image_$option
    [[ ! ${!file-} || -r ${!file} ]] || die "--$option: there is no file ${!file} that can be read"
  done
  if [[ ${image_keyring-} ]]; then check_keyring; fi
  development_key=no
  if [[ ! ${image_keyring-} ]]; then
    folder=$(development_keys) || exit 1
    image_key=$folder/signer.key image_certificate=$folder/signer.pem image_keyring=$folder/ca.pem
    development_key=yes
    say "WARNING: the development key is what this PC trusts ($folder): anyone who has it can make an update for this PC."
    say "For a PC that is in use: ./flexrf image --new-keys DIR, and --keyring"
  elif subjects_of_keyring | grep -q 'FlexRF development'; then
    development_key=yes
    say "WARNING: a development key is in the keyring: anyone who has it can make an update for this PC."
  fi
  if [[ ${image_key-} ]]; then check_keys "$image_key" "$image_certificate" "$image_keyring"; fi
}
