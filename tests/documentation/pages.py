# SPDX-License-Identifier: Apache-2.0
"""Which pages users read, and which commands of them are run."""
import pathlib

ROOMS = ["README.md", "CONTRIBUTING.md", "SECURITY.md", "apps/tandem/README.md", "apps/tandem/rtm/README.md",
         "apps/wheelchair/README.md", "apps/bench/README.md", "host/opros/YOUR_COMPONENT.md", "host/rtm/YOUR_COMPONENT.md",
         "host/rtm/DIFFERENCES.md"]

# Page: what run_page.py runs of it. "sh": all sh blocks; "console": lines that begin with `$ `, in blocks that show their
# output; "lines TEXT": those of sh blocks that contain the text; else the whole sh blocks that contain it.
RUN = {
    "docs/tutorial.md": "sh",
    "host/opros/YOUR_COMPONENT.md": "console",
    "host/rtm/YOUR_COMPONENT.md": "console",
    "docs/monitoring.md": "tandem replay run.mcap",
    "docs/two_machines.md": "openssl req -x509",
    "apps/wheelchair/README.md": "lines wheelchair --lockstep",
}

# Pages with commands of ours in blocks that no test runs as they stand: each is looked up in the help and named as not run, with this.
LOOKED_UP = {
    "apps/tandem/rtm/README.md": "is about RTCs of the reader's; tests/apps/tandem/rtm runs these sub-commands",
    "apps/wheelchair/README.md": "drives for 10 s and more, or asks for a person; tests/apps/wheelchair runs these options",
    "apps/bench/README.md": "measures for minutes; tests/apps/bench runs the program",
    "host/opros/YOUR_COMPONENT.md": "is about a component of the reader's; tests/apps/tandem/opros runs it",
    "host/rtm/YOUR_COMPONENT.md": "is about a component of the reader's; tests/apps/tandem/rtm runs it",
    "docs/joining.md": "is about components of the reader's; docs/tutorial.md and tests/apps/tandem/import run it",
    "docs/monitoring.md": "does not end by itself, or shows links that are not there; tests/apps/tandem runs it",
    "docs/packages.md": "is about an installation; was run by hand in an empty Debian, as the page says",
    "docs/two_machines.md": "needs two machines; tests/machines runs it in two network namespaces",
}


def pages(root):
    root = pathlib.Path(root)
    return ROOMS + sorted(str(page.relative_to(root)) for page in (root / "docs").glob("*.md"))


def console_parts(block):
    """Each command behind `$ ` with the numbered lines that follow it."""
    parts = []
    for number, line in enumerate(block.lines, block.line):
        if line.startswith("$ "):
            parts.append((number, line[2:], []))
        elif parts:
            parts[-1][2].append((number, line))
    return parts


def is_run(block, line):
    """Whether a test runs this line of the block."""
    mode = RUN.get(block.page, "none")
    if mode == "console":
        return line.startswith("$ ")
    if block.language != "sh":
        return False
    if mode.startswith("lines "):
        return mode.removeprefix("lines ") in line
    return mode == "sh" or (mode != "none" and mode in "\n".join(block.lines))


def is_whole(block):
    """Whether all of a block is run, with lines that only the shell understands."""
    return not RUN.get(block.page, "").startswith("lines ")
