#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What scripts print on other distributions, and about packages that cannot be installed.   distribution_test.sh ROOT
set -euo pipefail
. "$1/apps/setup.sh"

fail() { echo "distribution_test.sh: $1" >&2; exit 1; }
described() { describe_distribution <(printf 'ID=%s\nVERSION_ID="%s"\nPRETTY_NAME="%s"\n' "$@"); }

for version in 12 13; do [ -z "$(described debian $version "Debian $version")" ] || fail "Debian $version is not tested"; done
[ "$(described ubuntu 24.04 'Ubuntu 24.04 LTS')" = \
    '== Tandem is not tested on Ubuntu 24.04 LTS; docs/platforms.md says what is known' ] || fail "Ubuntu is not named"
[ -n "$(described debian 14 'Debian 14')" ] || fail "a later Debian is not named"

if said=$(PATH=/nowhere install_missing_packages 2>&1); then fail "a system without apt-get is accepted"; fi
case $said in 'apps/setup.sh: no apt-get on this system; '*) ;; *) fail "a system without apt-get prints: $said" ;; esac

# No compiler for arm64, and none can be installed.
stubs=$(mktemp -d)
trap 'rm -rf "$stubs"' EXIT
for program in dpkg-query apt-get sudo; do
    printf '#!/bin/sh\nexit 1\n' > "$stubs/$program"
    chmod +x "$stubs/$program"
done
if said=$(PATH=$stubs:$PATH "$1/tests/cross_compile.sh" 2>&1); then fail "cross_compile.sh succeeds without a compiler"; fi
case $said in *g++-*-linux-gnu*) ;; *) fail "without a compiler, cross_compile.sh prints: $said" ;; esac

# A caller that does without a group's packages hears that they are not there.
said=$(PATH=$stubs:$PATH; (install_missing_packages machines) || say "without them")
case $said in *'installed them'*) fail "packages that apt-get refuses count as installed: $said" ;; *'without them') ;; *) fail "printed: $said" ;; esac
if (install_missing_packages machine) 2>/dev/null; then fail "a group that does not exist has nothing to install"; fi
