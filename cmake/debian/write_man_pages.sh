#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# write_man_pages.sh PREFIX VERSION [EMULATOR]: a man page for each program in PREFIX/bin and each sub-command of tandem, made by
# help2man of what `--help` prints, in PREFIX/share/man/man1. EMULATOR runs programs for another processor.
set -euo pipefail
prefix=$1 version=$2
pages=$prefix/share/man/man1
export PATH=$prefix/bin:$PATH LD_LIBRARY_PATH=$prefix/lib LC_ALL=C.UTF-8
command -v help2man >/dev/null || { echo "write_man_pages.sh: help2man not found; apt install help2man" >&2; exit 1; }
mkdir -p "$pages"
if [ $# -gt 2 ]; then
    emulated=$(mktemp -d)
    trap 'rm -rf "$emulated"' EXIT
    for program in opros_host rtm_host tandem tandem-bench wheelchair; do
        printf '#!/bin/sh\nexec %s %s "$@"\n' "$3" "$prefix/bin/$program" >"$emulated/$program"
        chmod +x "$emulated/$program"
    done
    PATH=$emulated:$PATH
fi

# write_page PAGE COMMAND [help2man option ...]: from the help of COMMAND, whose first line is the summary of the page.
write_page() {
    local page=$1 summary
    summary=$($2 "${3:---help}" 2>&1 | sed -n '1{s/[.]$//;p}')
    case $summary in ''|[Uu]sage*) summary="part of Tandem" ;; esac
    help2man --no-info --no-discard-stderr --version-string "$version" --name "$summary" --manual Tandem \
        --source "Tandem $version" ${3:+--help-option="$3"} "$2" |
        sed -e "s/^\.TH [^ ]* /.TH ${page^^} /" -e "s/^${2//-/\\\\-} \\\\- /${page//-/\\\\-} \\\\- /" >"$pages/$page.1"
    [ -s "$pages/$page.1" ] || { echo "write_man_pages.sh: $2 has no help that a page can be made of" >&2; exit 1; }
}

# commands_below COMMAND: itself, and all sub-commands that its help names, those of these, ...
commands_below() {
    echo "$1"
    $1 --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z0-9_-]*\) .*/\1/p' | while read -r word; do commands_below "$1 $word"; done
}

export -f write_page
export pages version
{
    commands_below tandem
    printf '%s\n' opros_host rtm_host wheelchair tandem-bench rtm-config rtm-skelwrapper
} | sed 's/.*/write_page "$(echo "&" | tr " " -)" "&"/' | tr '\n' '\0' | xargs -0 -n 1 -P "$(nproc)" bash -euo pipefail -c
write_page rtm-naming rtm-naming -h
for name in config naming skelwrapper; do ln -s rtm-$name.1.gz "$pages/rtm2-$name.1.gz"; done
gzip -9n "$pages"/*.1
