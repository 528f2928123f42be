# SPDX-License-Identifier: Apache-2.0
"""The code blocks of a page of documentation."""
import dataclasses
import pathlib
import re

NOT_RUN = re.compile(r"#\s*not run by the test:\s*(.+)")


@dataclasses.dataclass
class Block:
    """A fenced block, or an indented one, whose language is "indented"."""
    page: str
    line: int  # of its first line of text
    language: str
    lines: list

    def where(self, offset=0):
        return f"{self.page}:{self.line + offset}"

    def split(self):
        """The lines that a test may run, and those behind a mark with its reason."""
        for number, line in enumerate(self.lines):
            if found := NOT_RUN.search(line):
                return self.lines[:number], self.lines[number + 1:], found[1]
        return self.lines, [], ""


def blocks(root, page):
    found, fence, indented = [], None, None
    for number, line in enumerate((pathlib.Path(root) / page).read_text().splitlines(), 1):
        mark = re.match(r"\s*```\s*(\w*)", line)
        if fence is not None:
            if mark:
                fence = None
            else:
                fence.lines.append(line)
        elif mark:
            fence = Block(page, number + 1, mark[1], [])
            found.append(fence)
        elif line.startswith("    "):
            if indented is None:
                indented = Block(page, number, "indented", [])
                found.append(indented)
            indented.lines.append(line[4:])
            continue
        indented = None
    return found
