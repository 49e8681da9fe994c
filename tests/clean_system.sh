# Clean systems that mmdebstrap makes (root; apt-get install mmdebstrap): sourced by chroot.sh and hashes/webassembly.sh.

# make_clean_system FOLDER RELEASE [PACKAGE...]
make_clean_system() {
  local folder=$1 release=$2
  shift 2
  rm -rf "${folder:?}"
  mkdir -p "$(dirname "$folder")"
  # A mirror that has not been brought up to date for a while will do.
  mmdebstrap --quiet --variant=minbase --aptopt='Acquire::Check-Valid-Until "false"' \
    ${1:+--include="$(IFS=,; echo "$*")"} "$release" "$folder" >&2
  cp /etc/resolv.conf "$folder/etc/resolv.conf"
}

# inside_system FOLDER COMMAND [SHOWN...]: with what programs expect to find, and the folders SHOWN by the names that they have
# here. In a room of its own, so that nothing stays mounted.
inside_system() {
  # shellcheck disable=SC2016  # it is the inner shell that expands them
  unshare --mount --pid --fork bash -ec 'system=$0 command=$1; shift
    mount -t proc none "$system/proc"; mount --rbind /dev "$system/dev"
    for shown in "$@"; do mkdir -p "$system$shown"; mount --bind "$shown" "$system$shown"; done
    exec chroot "$system" bash -ec "$command"' "$@"
}

# main_archive: where this machine has Debian's from, without that of security updates.
main_archive() {
  # shellcheck disable=SC2016  # it is apt-get that expands it
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | head -n 1
}
