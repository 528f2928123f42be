# SPDX-License-Identifier: Apache-2.0
"""omniidl back end: type signatures of the structs and operations of one IDL file.

`omniidl -p DIR -btandem_signatures F.idl` writes FSignatures.cpp. Its static initialiser fills
RTC::InterfaceSignatures, so that a bridge can carry calls of interfaces it was not compiled for. With -Wbinline, as for
omniidl's C++ back end, it also writes the signatures of the included files.
Names of members and arguments are in braces. Types that cannot cross (valuetypes, types that contain themselves) are
written as `?{reason}`. docs/wire_format.md describes the signature language.
"""
import os

from omniidl import idlast, idltype

PRIMITIVES = {
    idltype.tk_null: "", idltype.tk_void: "",
    idltype.tk_boolean: "b", idltype.tk_char: "c", idltype.tk_octet: "y",
    idltype.tk_short: "n", idltype.tk_ushort: "q", idltype.tk_long: "i", idltype.tk_ulong: "u",
    idltype.tk_longlong: "x", idltype.tk_ulonglong: "t",
    idltype.tk_float: "f", idltype.tk_double: "d",
    idltype.tk_longdouble: "D", idltype.tk_wchar: "W", idltype.tk_any: "v", idltype.tk_objref: "o",
    idltype.tk_TypeCode: "?{TypeCode}",
}
RECURSIVE = "?{a type that contains itself, whose depth only each value knows}"


def arrays(sizes, element):
    for size in reversed(sizes):
        element = "[%d]%s" % (size, element)
    return element


def bounded(code, bound):
    return code + ("#%d" % bound if bound else "")


def signature(t, seen=()):
    kind = t.kind()
    if kind in PRIMITIVES:
        return PRIMITIVES[kind]
    if kind == idltype.tk_string:
        return bounded("s", t.bound())
    if kind == idltype.tk_wstring:
        return bounded("w", t.bound())
    if kind == idltype.tk_fixed:
        return "F%d,%d" % (t.digits(), t.scale())
    if kind == idltype.tk_sequence:
        return bounded("a", t.bound()) + signature(t.seqType(), seen)
    if kind == idltype.tk_alias:
        declarator = t.decl()
        return arrays(declarator.sizes(), signature(declarator.alias().aliasType(), seen))
    if kind == idltype.tk_enum:
        return bounded("e", len(t.decl().enumerators()))
    decl = t.decl() if isinstance(t, idltype.Declared) else None
    if isinstance(decl, (idlast.StructForward, idlast.UnionForward)):
        decl = decl.fullDecl()
    if isinstance(decl, idlast.Struct):
        return struct_signature(decl, seen)
    if isinstance(decl, idlast.Union):
        return union_signature(decl, seen)
    return "?{valuetype}"


def named(declarator, element):
    return "{%s}%s" % (declarator.identifier(), arrays(declarator.sizes(), element))


def struct_signature(decl, seen=()):
    name = decl.repoId()
    if name in seen:
        return RECURSIVE
    parts = ""
    for member in decl.members():
        element = signature(member.memberType(), seen + (name,))
        parts += "".join(named(d, element) for d in member.declarators())
    return "(" + parts + ")"


def label(value, decl):
    """Returns the number of a case's label in the discriminator's type."""
    if isinstance(value, idlast.Enumerator):
        return str(decl.switchType().unalias().decl().enumerators().index(value))
    if isinstance(value, str):
        number = ord(value)
        return str(number - 256 if number > 127 else number)
    return str(int(value))


def label_groups(case, decl):
    """Returns the labels of a case, `1,2`; the default is a group of its own, so that no label is lost."""
    groups = [[]]
    for each in case.labels():
        if each.default():
            groups += [["*"], []]
        else:
            groups[-1].append(label(each.value(), decl))
    return [",".join(group) for group in groups if group]


def union_signature(decl, seen=()):
    name = decl.repoId()
    if name in seen:
        return RECURSIVE
    text = "<" + signature(decl.switchType(), seen + (name,))
    for case in decl.cases():
        member = named(case.declarator(), signature(case.caseType(), seen + (name,)))
        text += "".join(";%s=%s" % (labels, member) for labels in label_groups(case, decl))
    return text + ">"


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def raises_clause(exceptions):
    """Returns ` raises ID({name}T{name}T) ID()`, or an empty string."""
    text = ""
    for exception in exceptions:
        fields = "".join(named(d, signature(m.memberType())) for m in exception.members() for d in m.declarators())
        text += " %s(%s)" % (exception.repoId(), fields)
    return " raises" + text if text else ""


DIRECTIONS = {(True, False): "", (False, True): ">", (True, True): "&"}


def operation_signature(operation):
    """Returns (arguments, result) for wire::parse_operation, the result with ` oneway` or ` raises`."""
    arguments = "".join("%s{%s}%s" % (DIRECTIONS[bool(p.is_in()), bool(p.is_out())], p.identifier(),
                                      signature(p.paramType())) for p in operation.parameters())
    result = signature(operation.returnType())
    return arguments, result + (" oneway" if operation.oneway() else "") + raises_clause(operation.raises())


def operations(interface):
    """Returns (name, arguments, result) of an interface's own and inherited operations, each name once."""
    found = {}
    for base in interface.inherits():
        while isinstance(base, idlast.Declarator):
            base = base.alias().aliasType().decl()
        for entry in operations(base):
            found[entry[0]] = entry
    for callable_ in interface.callables():
        if isinstance(callable_, idlast.Attribute):
            value = "{value}" + signature(callable_.attrType())
            for name in callable_.identifiers():
                found["_get_" + name] = ("_get_" + name, "", value)
                if not callable_.readonly():
                    found["_set_" + name] = ("_set_" + name, value, "")
            continue
        found[callable_.identifier()] = (callable_.identifier(),) + operation_signature(callable_)
    return [found[name] for name in sorted(found)]


class Collector:
    def __init__(self, with_included):
        self.with_included = with_included
        self.lines = []
        self.interfaces = []

    def wanted(self, declaration, kind):
        return isinstance(declaration, kind) and (self.with_included or declaration.mainFile())

    def visit(self, declarations):
        for d in declarations:
            if isinstance(d, idlast.Module):
                self.visit(d.definitions())
            elif self.wanted(d, idlast.Struct):
                self.lines.append("    {%s, %s}," % (quoted(d.repoId()), quoted(struct_signature(d))))
            elif self.wanted(d, idlast.Union):
                self.lines.append("    {%s, %s}," % (quoted(d.repoId()), quoted(union_signature(d))))
            elif self.wanted(d, idlast.Interface):
                self.interface(d)

    def interface(self, decl):
        self.visit(decl.declarations())
        entries = ", ".join("{%s, %s, %s}" % tuple(map(quoted, o)) for o in operations(decl))
        self.interfaces.append("    {%s, {%s}}," % (quoted(decl.repoId()), entries))


def run(tree, args):
    collector = Collector("inline" in args)
    collector.visit(tree.declarations())
    base = os.path.splitext(os.path.basename(tree.file()))[0]
    with open(base + "Signatures.cpp", "w") as out:
        out.write("// Made by omniidl's back end tandem_signatures from %s; changes are lost.\n" % (base + ".idl"))
        out.write("#include <rtm/InterfaceSignatures.h>\n\nnamespace {\n")
        out.write("const RTC::InterfaceSignatures::Registration registration{{\n%s\n}, {\n%s\n}};\n}\n"
                  % ("\n".join(collector.interfaces), "\n".join(collector.lines)))
