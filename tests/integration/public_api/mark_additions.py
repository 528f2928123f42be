#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Copies a tree of API headers as the model's own engine has them. It marks as deprecated what is not in the public API of the model:
what has a comment that begins with "Ours" or says "(ours", and what ADDITIONS names. It takes out what makes our headers work in any
order, so that the copy depends on the order of includes as OpenRTM-aist does (REPLACEMENTS, DATA_TYPES). Usage:
mark_additions.py FROM TO. Prints how many declarations it has marked."""
import pathlib
import re
import sys

MARK = '[[deprecated("this is not in the public API of the model")]] '
# Without such a comment: in these headers the declarations that begin so.
ADDITIONS = {
    "rtm/OutPortBase.h": ["void dropLostConnections("],
    "rtm/ConnectorListener.h": ["bool has("],
    "LifecycleInterface.h": ["void removeLifecycleListener("],
    "OPRoSAny.h": ["bool serializable() const {", "void encode(opros::archive::oarchive& ar) const {",
                   "void decode(opros::archive::iarchive& ar) {", "bool holds() const {", "class opros_any_view {"],
    "PortInterface.h": ["void removePortListener("],
    "ServicePort.h": ["virtual bool isDynamic("],
}
# OpenRTM-aist's port templates find `Any <<= T` only if it is declared before them: omniidl declares it outside of the type's
# namespace, where argument-dependent lookup does not look. Our templates find it in any order.
REPLACEMENTS = {
    "rtm/Typename.h": [("const RtmAnyProbe<T> probe;", "const T probe = T();"),
                       ("const RtmAnyReference<T> probe;", "T* const probe = 0;")],
}
# No header of OpenRTM-aist includes these skeletons before those templates.
DATA_TYPES = re.compile(r"^#include <rtm/idl/(BasicDataType|ExtendedDataTypes|InterfaceDataTypes)Skel\.h>$", re.M)
OURS = re.compile(r"^\s*/// (Ours\b|.*\(ours\b)")
COMMENT = re.compile(r"^\s*//")
CLASS = re.compile(r"^(\s*(?:template <.*> )?(?:class|struct) )(?=\w+( final)?( :.*)? ?\{|\w+$)")
TEMPLATE = re.compile(r"^\s*template <.*>$")
FRIEND = re.compile(r"^\s*friend\b")
PREPROCESSOR = re.compile(r"^\s*#")


def mark(line):
    """The declaration with an attribute, which precedes it, or the name of a class."""
    if CLASS.match(line):
        return CLASS.sub(lambda found: found[1] + MARK, line)
    return re.sub(r"^(\s*)", lambda found: found[1] + MARK, line, count=1)


def marked(text, additions):
    whole_file_is_ours = any(line.startswith("// Ours") for line in text.splitlines()[:3])
    lines, is_next, count = [], False, 0
    for line in text.splitlines():
        is_next = is_next or bool(OURS.match(line))
        is_declaration = not any(other.match(line) for other in (COMMENT, TEMPLATE, FRIEND, PREPROCESSOR))
        if is_declaration and (is_next or any(line.strip().startswith(each) for each in additions) or
                               (whole_file_is_ours and CLASS.match(line) and not line.startswith(" "))):
            line = mark(line)
            count += 1
        if is_declaration:
            is_next = False
        lines.append(line)
    return "\n".join(lines) + "\n", count


def ordered(name, text):
    """The header's text, with those templates, and before the data types that it includes itself."""
    for ours, theirs in REPLACEMENTS.get(name, []):
        if ours not in text:
            sys.exit(f"mark_additions.py: {name}: '{ours}' of REPLACEMENTS is not there any more; change that list")
        text = text.replace(ours, theirs)
    if not name.startswith("rtm/idl/"):
        text = DATA_TYPES.sub(lambda found: "#include <rtm/Typename.h>\n" + found[0], text, count=1)
    return text


def main():
    source, target = map(pathlib.Path, sys.argv[1:3])
    total = 0
    for header in sorted(source.rglob("*.h")):
        name = header.relative_to(source).as_posix()
        text, count = marked(ordered(name, header.read_text()), ADDITIONS.get(name, []))
        if count < len(ADDITIONS.get(name, [])):
            sys.exit(f"mark_additions.py: {header}: a declaration of ADDITIONS is not there any more; change that list")
        total += count
        copy = target / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        if not copy.exists() or copy.read_text() != text:
            copy.write_text(text)
    print(f"{total} declarations are marked")


if __name__ == "__main__":
    main()
