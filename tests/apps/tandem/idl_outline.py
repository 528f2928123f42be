# SPDX-License-Identifier: Apache-2.0
"""omniidl back end for tests: what the interfaces of a file consist of, with aliases resolved and inherited operations included,
one line for each operation, attribute and type. Two files with the same interfaces give the same lines in the same order."""
from omniidl import idlast, idltype

lines = set()


def scoped(decl):
    return "::".join(decl.scopedName())


def sizes(d):
    return "".join("[%d]" % size for size in d.sizes())


def type_text(t):
    kind = t.kind()
    if kind == idltype.tk_sequence:
        return "sequence<%s>" % type_text(t.seqType())
    if kind == idltype.tk_alias:
        d = t.decl()
        return type_text(d.alias().aliasType()) + sizes(d)
    if isinstance(t, idltype.Declared):
        decl = t.decl()
        describe(decl)
        return scoped(decl)
    return "kind%d" % kind


def members(decl):
    return "; ".join("%s %s%s" % (type_text(m.memberType()), d.identifier(), sizes(d))
                     for m in decl.members() for d in m.declarators())


def label(value):
    return scoped(value) if isinstance(value, idlast.Enumerator) else repr(value)


def describe(decl):
    if isinstance(decl, idlast.Enum):
        lines.add("enum %s: %s" % (scoped(decl), ", ".join(e.identifier() for e in decl.enumerators())))
    elif isinstance(decl, idlast.Struct):
        lines.add("struct %s: %s" % (scoped(decl), members(decl)))
    elif isinstance(decl, idlast.Exception):
        lines.add("exception %s: %s" % (scoped(decl), members(decl)))
    elif isinstance(decl, idlast.Union):
        cases = ["%s: %s %s%s" % ("default" if any(l.default() for l in c.labels())
                                  else ",".join(label(l.value()) for l in c.labels()),
                                  type_text(c.caseType()), c.declarator().identifier(), sizes(c.declarator()))
                 for c in decl.cases()]
        lines.add("union %s(%s): %s" % (scoped(decl), type_text(decl.switchType()), "; ".join(cases)))


def callables(interface):
    for base in interface.inherits():
        yield from callables(base)
    yield from interface.callables()


def visit(declarations):
    for d in declarations:
        if isinstance(d, idlast.Module):
            visit(d.definitions())
        elif isinstance(d, idlast.Interface) and d.mainFile():
            for c in callables(d):
                if isinstance(c, idlast.Attribute):
                    for name in c.identifiers():
                        lines.add("%s: %sattribute %s %s" % (scoped(d), "readonly " if c.readonly() else "",
                                                             type_text(c.attrType()), name))
                    continue
                arguments = ", ".join("%d %s %s" % (p.direction(), type_text(p.paramType()), p.identifier())
                                      for p in c.parameters())
                for e in c.raises():
                    describe(e)
                lines.add("%s: %s%s %s(%s) raises(%s)" % (
                    scoped(d), "oneway " if c.oneway() else "", type_text(c.returnType()), c.identifier(), arguments,
                    ", ".join(scoped(e) for e in c.raises())))


def run(tree, args):
    visit(tree.declarations())
    print("\n".join(sorted(lines)))
