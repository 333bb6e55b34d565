#!/bin/sh
# client/embed/make_deb.sh FOLDER: the installation as three Debian packages: seam2d (programs, scenes, shared library,
# docs), seam2d-dev (headers, library, types of messages) and python3-seam2d. Builds nothing (`make deb` does before).
set -eu
PYTHON3=${PYTHON3:-/usr/bin/python3}
folder=$1
rm -rf "$folder"
mkdir -p "$folder/stage/debian"
work=$(cd "$folder/stage" && pwd)
env -u MAKEFLAGS -u MAKELEVEL "${MAKE:-make}" --no-print-directory install-built BUILD="$BUILD" \
  DESTDIR="$work/all" PREFIX=/usr > "$folder/install.log"
architecture=$(dpkg --print-architecture)
printf 'Source: seam2d\n\nPackage: seam2d\nArchitecture: any\n' > "$work/debian/control"

move() {  # PACKAGE PATH...: of the installation into the package
  package=$1; shift
  for path; do
    mkdir -p "$work/$package/$(dirname "$path")"
    mv "$work/all/$path" "$work/$package/$path"
  done
}

needs() {  # FILE...: the packages of the libraries that they are linked with
  (cd "$work" && dpkg-shlibdeps -O --ignore-missing-info -lall/usr/lib "$@" 2> shlibs.log) | sed 's/^shlibs:Depends=//'
}

pack() {  # PACKAGE DEPENDS SUMMARY
  mkdir -p "$work/$1/DEBIAN" "$work/$1/usr/share/doc/$1"
  cp -n LICENSE "$work/$1/usr/share/doc/$1/copyright"
  size=$(du -sk "$work/$1/usr" | cut -f1)
  printf 'Package: %s\nVersion: %s\nArchitecture: %s\nMaintainer: Seam2D <seam2d@localhost>\nInstalled-Size: %s\nDepends: %s\nSection: games\nPriority: optional\nDescription: %s\n' \
    "$1" "$VERSION" "$architecture" "$size" "$2" "$3" > "$work/$1/DEBIAN/control"
  dpkg-deb --root-owner-group -Zxz -z1 --build "$work/$1" "$folder/$1_${VERSION}_$architecture.deb" > /dev/null
}

python=$("$PYTHON3" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
next=$("$PYTHON3" -c 'import sys; print("%d.%d" % (sys.version_info[0], sys.version_info[1] + 1))')
programs=$(cd "$work" && needs all/usr/bin/* all/usr/lib/libseam2d.so.*)
module=$(cd "$work" && needs all/usr/lib/python3/dist-packages/seam/_seam.so)
[ ! -e "$work/all/usr/share/java" ] || move seam2d-dev usr/share/java
move seam2d-dev usr/include usr/lib/libseam.a usr/lib/libseam2d.so usr/lib/pkgconfig usr/lib/cmake usr/share/seam2d/lcmtypes
move python3-seam2d usr/lib/python3
move seam2d usr
mkdir -p "$work/seam2d/DEBIAN"
echo 'activate-noawait ldconfig' > "$work/seam2d/DEBIAN/triggers"
pack seam2d "$programs" 'distributed 2D physics runtime: programs and shared library'
pack seam2d-dev "seam2d (= $VERSION), libeigen3-dev, liblcm-dev, libbox2d-dev, libfmt-dev, libsodium-dev, libzstd-dev, liblua5.4-dev" \
  'distributed 2D physics runtime: headers, library, types of messages'
pack python3-seam2d "python3 (>= $python), python3 (<< $next), python3-numpy, $module" 'distributed 2D physics runtime: Python module'
rm -rf "$work"
ls "$folder"/*.deb
