#!/bin/sh
# container.sh build SOURCE | install FILE.deb - what the recipes of containers do (Dockerfile, apptainer.def), in a Debian
# that may have nothing yet: `build` leaves /bulla.deb, made from the tree SOURCE; `install` installs it, with its MPI.
set -eu
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
case $1 in
build)
    apt-get install -y -qq --no-install-recommends $(sed -n '/^packages="/,/"$/p' "$2/bulla" | tr -d '"' | sed 's/^packages=//') \
        dpkg-dev file git ca-certificates >/dev/null
    git config --global --add safe.directory "$2" # the commit goes into provenance.json
    cmake -S "$2" --preset release -B /bulla-build -DBULLA_TESTS=OFF
    cmake --build /bulla-build
    (cd /bulla-build && cpack -G DEB)
    cp /bulla-build/bulla_*.deb /bulla.deb
    ;;
install)
    apt-get install -y -qq --no-install-recommends "$2" >/dev/null
    rm -rf /var/lib/apt/lists/*
    ;;
esac
