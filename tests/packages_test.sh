#!/usr/bin/env bash
# demos/packages.sh on distributions that this machine is not: dpkg-query and apt-cache answer as they would there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source demos/packages.sh

installed= offered=
dpkg-query() { [[ " $installed " == *" ${!#} "* ]] && echo "install ok installed"; }
apt-cache() { [[ " $offered " == *" $2 "* ]] && echo "  Candidate: 1.0" || echo "  Candidate: (none)"; }
fail() { echo "$1" >&2; exit 1; }
expect() { [ "$(needed_of "$1")" = "$2" ] || fail "$1 with \"$installed\" there and \"$offered\" offered: $(needed_of "$1"), not $2"; }

gl='libosmesa6|libegl1,libegl-mesa0,libgl1-mesa-dri'
[[ " ${carom_packages[*]} " == *" $gl "* ]] || fail "the build no longer asks for $gl"
offered='libosmesa6 libegl1 libegl-mesa0 libgl1-mesa-dri g++'
expect "$gl" libosmesa6        # Debian 12 and 13, Ubuntu 24.04
expect g++ g++
installed=libosmesa6 expect "$gl" ''
installed='libegl1 libegl-mesa0 libgl1-mesa-dri' expect "$gl" ''
offered='libegl1 libegl-mesa0 libgl1-mesa-dri'
expect "$gl" 'libegl1 libegl-mesa0 libgl1-mesa-dri'  # the next Debian
installed=libegl1 expect "$gl" 'libegl1 libegl-mesa0 libgl1-mesa-dri'
expect nowhere nowhere         # apt says that it has none

# One that cannot be had does not keep the others away.
(
  id() { echo 0; }
  env() { shift; "$@"; }
  apt-get() { case " $* " in *" nowhere "*) return 1 ;; *" install "*) installed+=" ${!#}" ;; esac; }
  offered='idiff nowhere zsh' installed=
  told=$(install_what_is_had idiff nowhere zsh 2>&1)
  [ "$told" = "could not install: nowhere" ] || fail "$told"
  install_what_is_had idiff nowhere zsh 2>/dev/null
  [ "$installed" = " idiff zsh" ] || fail "installed$installed"
)

# Nobody without the right to install is told of the distribution's own packages, in one line.
id() { echo 1000; }
sudo() { return 1; }
carom_packages=("$gl" g++) installed=g++
told=$(install_missing_packages 2>&1 </dev/null) && fail "installed without the right to"
[ "$told" = "missing packages, and no right to install them: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri" ] || fail "$told"
told=$(install_what_is_had g++ "$gl" 2>&1 </dev/null) || fail "what cannot be had is a failure"
[ "$told" = "missing packages, and no right to install them: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri" ] || fail "$told"
