#!/bin/sh
# package.sh [FILE.deb] - installs the Debian package (of build-deb, which is made if none is named) into a fresh Debian and
# uses it there as an ordinary user: a run, two ranks with the same bits, pictures, a report, the page of a run, the list
# of verification scenes, the skeleton of a module. Nothing of this tree is seen there. For root, with mmdebstrap and a
# mirror of Debian ($BULLA_MIRROR), else it ends with 77; some minutes, most of them downloads. Nightly.
set -eu
[ "$(id -u)" = 0 ] && command -v mmdebstrap >/dev/null || { echo "needs root and mmdebstrap"; exit 77; }
root=$(cd -- "$(dirname -- "$0")/.." && pwd)
package=${1-}
[ -n "$package" ] || {
    cmake -S "$root" --preset release -B "$root/build-deb" -DBULLA_TESTS=OFF >&2
    cmake --build "$root/build-deb" >&2
    (cd "$root/build-deb" && cpack -G DEB >&2)
    package=$(ls "$root"/build-deb/bulla_*.deb)
}
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cp "$package" "$place/bulla.deb"
cat >"$place/try" <<'END'
set -eu
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -y -qq --no-install-recommends /root/bulla.deb >/root/log 2>&1 || { tail /root/log; exit 1; }
useradd -m user
su user -c '
set -eu
cd
bulla version
case=/usr/share/bulla/cases/tour/tube.yaml
for ranks in 1 2 3; do
    bulla run $case -o run$ranks -n $ranks --quiet
    cmp run1/history.csv run$ranks/history.csv
done
bulla plot run1 density
bulla report run1
(cd / && bulla verify --list) | grep -q a2-crossing
bulla modules | grep -q stiffened-gas
bulla new module eos my-water >said
test -f my-water/Makefile
test -s run1/report.html
(timeout 3 bulla watch run1 || true) | grep -q "^http://127.0.0.1"'
echo 'the package installs and runs'
END
# What is known of the machine is mounted: Open MPI looks for its network and its processors there.
mmdebstrap --variant=minbase --format=null --quiet \
    --customize-hook="cp '$place/bulla.deb' '$place/try' \"\$1/root/\"" \
    --customize-hook='mkdir -p "$1/sys" "$1/proc"; mount --rbind /sys "$1/sys"; mount -t proc proc "$1/proc"' \
    --customize-hook='code=0; chroot "$1" sh /root/try || code=1; umount -l "$1/sys" "$1/proc"; exit $code' \
    "$(. /etc/os-release && echo "$VERSION_CODENAME")" - "${BULLA_MIRROR:-http://deb.debian.org/debian}"
