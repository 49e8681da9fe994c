#!/usr/bin/env bash
# The state hashes in WebAssembly, in a system of its own that mmdebstrap makes (root; hash_table.sh's cell wasm-O2):
#   webassembly.sh make SYSTEM                 Debian 13 with emscripten, node, and the libraries that the program needs,
#                                              built for WebAssembly from Debian 12's sources, into SYSTEM/prefix
#   webassembly.sh build SYSTEM FOLDER FLAGS   this checkout's state_hashes, into FOLDER, compiled with FLAGS
#   webassembly.sh run SYSTEM FILE.js ...      by node; folders have the names there that they have here
# Of assimp, the readers of what the shipped scenes hold: OBJ, OFF, PLY, STL and glTF.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/clean_system.sh

command=$1 system=$(realpath -m "$2")
shift 2
common="-fwasm-exceptions -ffp-contract=off"

make_system() {
  make_clean_system "$system" trixie emscripten nodejs cmake ninja-build dpkg-dev pkg-config libeigen3-dev nlohmann-json3-dev \
    libcli11-dev libutfcpp-dev libstb-dev
  echo "deb-src $(main_archive) bookworm main" >"$system/etc/apt/sources.list.d/sources.list"
  inside_system "$system" "$(declare -f unpack_sources build_small build_assimp describe_small); common='$common'
    unpack_sources; build_small; build_assimp; describe_small" >&2
}

unpack_sources() {
  mkdir -p /sources
  cd /sources
  apt-get -q -o Acquire::Check-Valid-Until=false update
  for source in qhull zlib libpng1.6 assimp tinygltf; do apt-get -q source "$source"; done
  mkdir -p /prefix/include /prefix/lib/cmake/{Qhull,TinyGLTF,draco} /prefix/lib/pkgconfig /prefix/share/cmake
  cp -r /usr/include/{eigen3,nlohmann,CLI,utf8,utf8.h,utf8cpp,stb} /prefix/include  # emscripten does not look where Debian has them
  cp -r /usr/share/cmake/nlohmann_json /prefix/share/cmake
}

# Libraries of a few files: compiled as they are.
build_small() {
  local zlib png qhull gltf compile
  zlib=$(echo /sources/zlib-*/) png=$(echo /sources/libpng1.6-*/) qhull=$(echo /sources/qhull-*/src) gltf=$(echo /sources/tinygltf-*/)
  read -ra compile <<<"-O2 -w $common -I/prefix/include -c"
  cp "$zlib"/*.h "$png"/*.h /prefix/include
  cp "$png/scripts/pnglibconf.h.prebuilt" /prefix/include/pnglibconf.h
  cp -r "$zlib/contrib/minizip" "$qhull/libqhull_r" /prefix/include
  cp "$gltf/tiny_gltf.h" /prefix/include
  archive_of() { local name=$1; shift; mkdir -p /b/"$name"; (cd /b/"$name"; emcc "${compile[@]}" "$@"; emar rcs /prefix/lib/lib"$name".a *.o); }
  archive_of z -DHAVE_UNISTD_H "$zlib"/{adler32,compress,crc32,deflate,gzclose,gzlib,gzread,gzwrite,infback,inffast,inflate,inftrees,trees,uncompr,zutil}.c
  archive_of minizip -Dfopen64=fopen -Dftello64=ftello -Dfseeko64=fseeko "$zlib"/contrib/minizip/{unzip,ioapi}.c
  archive_of png "$png"/png{,error,get,mem,pread,read,rio,rtran,rutil,set,trans,wio,write,wtran,wutil}.c
  archive_of qhull_r -I"$qhull" "$qhull"/libqhull_r/*.c
  archive_of tinygltf -I/prefix/include/stb -I/prefix/include/nlohmann "$gltf/tiny_gltf.cc"
}

build_assimp() {
  local assimp readers=() name
  assimp=$(echo /sources/assimp-*/)
  for name in OBJ OFF PLY STL GLTF; do readers+=("-DASSIMP_BUILD_${name}_IMPORTER=ON"); done
  printf 'Name: minizip\nDescription: of zlib\nVersion: 1.1\nLibs: -L/prefix/lib -lminizip -lz\nCflags: -I/prefix/include/minizip\n' >/prefix/lib/pkgconfig/minizip.pc
  touch /prefix/lib/cmake/draco/dracoConfig.cmake  # asked for, and not used
  export PKG_CONFIG_LIBDIR=/prefix/lib/pkgconfig
  emcmake cmake -S "$assimp" -B /b/assimp -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/prefix -DCMAKE_PREFIX_PATH=/prefix \
    -DCMAKE_FIND_ROOT_PATH=/prefix -DBUILD_SHARED_LIBS=OFF -DCMAKE_C_FLAGS="-w $common" \
    -DCMAKE_CXX_FLAGS="-w $common -I/prefix/include -I$assimp/contrib/rapidjson/include -include rapidjson/stringbuffer.h" \
    -DASSIMP_BUILD_ALL_IMPORTERS_BY_DEFAULT=OFF "${readers[@]}" -DASSIMP_NO_EXPORT=ON -DASSIMP_BUILD_TESTS=OFF \
    -DASSIMP_BUILD_ASSIMP_TOOLS=OFF -DASSIMP_BUILD_ZLIB=OFF -DASSIMP_BUILD_DRACO=OFF -DASSIMP_WARNINGS_AS_ERRORS=OFF \
    -DZLIB_LIBRARY=/prefix/lib/libz.a -DZLIB_INCLUDE_DIR=/prefix/include
  ninja -C /b/assimp install
}

# What CMake and pkg-config ask for.
describe_small() {
  printf 'Name: CLI11\nDescription: command lines\nVersion: 2.4\nCflags: -I/prefix/include\n' >/prefix/lib/pkgconfig/CLI11.pc
  local folder name library
  for name in Qhull:qhull_r TinyGLTF:TinyGLTF; do
    folder=${name%:*} library=${name#*:}
    printf 'add_library(%s::%s STATIC IMPORTED)\nset_target_properties(%s::%s PROPERTIES IMPORTED_LOCATION %s\n  INTERFACE_INCLUDE_DIRECTORIES %s)\n' \
      "$folder" "$library" "$folder" "$library" "/prefix/lib/lib${library,,}.a" /prefix/include >"/prefix/lib/cmake/$folder/${folder}Config.cmake"
  done
}

build_program() {
  local folder=$1 flags=$2
  mkdir -p "$folder"
  inside_system "$system" "export PKG_CONFIG_LIBDIR=/prefix/lib/pkgconfig EM_PKG_CONFIG_PATH=/prefix/lib/pkgconfig
    emcmake cmake -S '$PWD' -B '$folder' -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=/prefix -DCMAKE_FIND_ROOT_PATH=/prefix \
      -DCMAKE_CXX_FLAGS='$common -D_LIBCPP_ENABLE_EXPERIMENTAL -include $PWD/tests/hashes/webassembly.h' \
      -DCMAKE_CXX_FLAGS_RELEASE='$flags -DNDEBUG' -DCMAKE_UNITY_BUILD=ON -DCAROM_RENDERER=OFF -DCAROM_BUILD_TESTS=OFF \
      -DCMAKE_EXE_LINKER_FLAGS='-L/prefix/lib -sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sEXIT_RUNTIME=1 -sSTACK_SIZE=8MB' \
      -DEigen3_DIR=/usr/share/eigen3/cmake -DQhull_DIR=/prefix/lib/cmake/Qhull -DTinyGLTF_DIR=/prefix/lib/cmake/TinyGLTF \
      -Dassimp_DIR=\$(dirname \$(ls /prefix/lib/cmake/assimp-*/*onfig.cmake)) -Dnlohmann_json_DIR=/prefix/share/cmake/nlohmann_json \
      -DPNG_PNG_INCLUDE_DIR=/prefix/include -DPNG_LIBRARY=/prefix/lib/libpng.a -DZLIB_LIBRARY=/prefix/lib/libz.a -DZLIB_INCLUDE_DIR=/prefix/include
    ninja -C '$folder' state_hashes" "$PWD" "$folder"
}

case $command in
  make)
    trap 'rm -rf "$system"' EXIT  # half of one is none
    make_system
    trap - EXIT
    ;;
  build) build_program "$(realpath -m "$1")" "$2" ;;
  run)
    program=$(realpath "$1")
    shift
    inside_system "$system" "cd '$PWD'; node '$program' ${*@Q}" "$PWD" "$(dirname "$program")"
    ;;
  *) echo "webassembly.sh make, build or run" >&2; exit 2 ;;
esac
