#!/bin/sh
# container.sh - builds packaging/Dockerfile with Podman, which reads it as Docker does, on a Debian 12 that
# mmdebstrap makes (so that no registry is asked), and uses the image as an ordinary user who mounts a folder: runs on one and
# two ranks with the same bits, a picture, nothing else left in the folder. For root, with podman and mmdebstrap and a mirror
# of Debian, else it ends with 77; ten minutes. Where crun cannot start containers: BULLA_PODMAN='podman --runtime runc'.
# Nightly.
set -eu
command -v podman >/dev/null && command -v mmdebstrap >/dev/null || { echo "there is no podman, or no mmdebstrap"; exit 77; }
[ "$(id -u)" = 0 ] || { echo "needs root"; exit 77; }
root=$(cd -- "$(dirname -- "$0")/.." && pwd)
podman=${BULLA_PODMAN:-podman}
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
base=docker.io/library/debian:12
podman image exists $base || mmdebstrap --variant=minbase --quiet bookworm - "${BULLA_MIRROR:-http://deb.debian.org/debian}" |
    podman import - $base >&2
git -C "$root" archive HEAD | tar -x -C "$place" --one-top-level=tree
(cd "$place/tree" && $podman build --pull=never -f packaging/Dockerfile -t bulla . >&2)

mkdir "$place/work"
cp "$root/cases/tour/tube.yaml" "$place/work/case.yaml"
chown -R 1000:1000 "$place/work"
chmod 755 "$place"
cd "$place/work"
bulla() { $podman run --rm --ulimit nofile=1024:1024 --ulimit nproc=4096:4096 -v "$PWD:/work" -u 1000:1000 bulla "$@"; }
for ranks in 1 2; do
    bulla run case.yaml -n $ranks -o run$ranks --quiet
done
cmp run1/history.csv run2/history.csv
bulla plot run1 density
[ "$(ls -A)" = "$(printf '%s\n' case.yaml run1 run2)" ] || { ls -A; exit 1; }
[ "$(stat -c %u run1/history.csv)" = 1000 ]
echo 'the container builds and runs'
