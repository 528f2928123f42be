# SPDX-License-Identifier: Apache-2.0
"""omniidl back end: type signatures of the structs and operations of one IDL file.

`omniidl -p DIR -btandem_signatures F.idl` writes FSignatures.cpp, whose static initialiser fills
RTC::InterfaceSignatures, so that a bridge can carry calls of interfaces it has never been compiled for.
Arguments are those a request carries (in, inout) in order; results those a reply carries: return value,
then inout and out. What the signature language cannot say (any, object references, unions, valuetypes,
wchar, long double, recursion) is written `?`, and a bridge refuses that operation by name.
"""
import os

from omniidl import idlast, idltype

PRIMITIVES = {
    idltype.tk_null: "", idltype.tk_void: "",
    idltype.tk_boolean: "b", idltype.tk_char: "c", idltype.tk_octet: "y",
    idltype.tk_short: "n", idltype.tk_ushort: "q", idltype.tk_long: "i", idltype.tk_ulong: "u",
    idltype.tk_longlong: "x", idltype.tk_ulonglong: "t",
    idltype.tk_float: "f", idltype.tk_double: "d",
    idltype.tk_string: "s", idltype.tk_wstring: "w", idltype.tk_enum: "u",
}


def arrays(sizes, element):
    for size in reversed(sizes):
        element = "[%d]%s" % (size, element)
    return element


def signature(t, seen=()):
    kind = t.kind()
    if kind in PRIMITIVES:
        return PRIMITIVES[kind]
    if kind == idltype.tk_sequence:
        return "a" + signature(t.seqType(), seen)
    if kind == idltype.tk_alias:
        declarator = t.decl()
        return arrays(declarator.sizes(), signature(declarator.alias().aliasType(), seen))
    if kind == idltype.tk_struct:
        return struct_signature(t.decl(), seen)
    return "?"


def struct_signature(decl, seen=()):
    name = decl.repoId()
    if name in seen:
        return "?"
    parts = ""
    for member in decl.members():
        element = signature(member.memberType(), seen + (name,))
        parts += "".join(arrays(d.sizes(), element) for d in member.declarators())
    return "(" + parts + ")"


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def operations(interface):
    """(name, arguments, result) of an interface and of all it inherits, each name once."""
    found = {}
    for base in interface.inherits():
        while isinstance(base, idlast.Declarator):
            base = base.alias().aliasType().decl()
        for entry in operations(base):
            found[entry[0]] = entry
    for callable_ in interface.callables():
        if isinstance(callable_, idlast.Attribute):
            value = signature(callable_.attrType())
            for name in callable_.identifiers():
                found["_get_" + name] = ("_get_" + name, "", value)
                if not callable_.readonly():
                    found["_set_" + name] = ("_set_" + name, value, "")
            continue
        sent = "".join(signature(p.paramType()) for p in callable_.parameters() if p.is_in())
        returned = signature(callable_.returnType())
        returned += "".join(signature(p.paramType()) for p in callable_.parameters() if p.is_out())
        found[callable_.identifier()] = (callable_.identifier(), sent, returned)
    return [found[name] for name in sorted(found)]


class Collector:
    def __init__(self):
        self.lines = []

    def visit(self, declarations):
        for d in declarations:
            if isinstance(d, idlast.Module):
                self.visit(d.definitions())
            elif d.mainFile() and isinstance(d, idlast.Struct):
                self.lines.append("    {%s, %s}," % (quoted(d.repoId()), quoted(struct_signature(d))))
            elif d.mainFile() and isinstance(d, idlast.Interface):
                self.interface(d)

    def interface(self, decl):
        self.visit(decl.declarations())
        self.interfaces = getattr(self, "interfaces", [])
        entries = ", ".join("{%s, %s, %s}" % tuple(map(quoted, o)) for o in operations(decl))
        self.interfaces.append("    {%s, {%s}}," % (quoted(decl.repoId()), entries))


def run(tree, args):
    collector = Collector()
    collector.visit(tree.declarations())
    base = os.path.splitext(os.path.basename(tree.file()))[0]
    with open(base + "Signatures.cpp", "w") as out:
        out.write("// Made by omniidl's back end tandem_signatures from %s; changes are lost.\n" % (base + ".idl"))
        out.write("#include <rtm/InterfaceSignatures.h>\n\nnamespace {\n")
        out.write("const RTC::InterfaceSignatures::Registration registration{{\n%s\n}, {\n%s\n}};\n}\n"
                  % ("\n".join(getattr(collector, "interfaces", [])), "\n".join(collector.lines)))
