# SPDX-License-Identifier: Apache-2.0
"""The C++ types of IDL types, for OPRoS components. Part of tandem_opros.py."""
import os

from omniidl import idlast, idltype

PRIMITIVES = {
    idltype.tk_void: "void", idltype.tk_boolean: "bool", idltype.tk_char: "char", idltype.tk_octet: "unsigned char",
    idltype.tk_short: "short", idltype.tk_ushort: "unsigned short", idltype.tk_long: "int",
    idltype.tk_ulong: "unsigned int", idltype.tk_longlong: "long long", idltype.tk_ulonglong: "unsigned long long",
    idltype.tk_float: "float", idltype.tk_double: "double", idltype.tk_string: "std::string",
    idltype.tk_longdouble: "long double", idltype.tk_wchar: "wchar_t", idltype.tk_wstring: "std::wstring",
    idltype.tk_objref: "std::string", # an object reference is an opaque text
    idltype.tk_any: "idl::any",
}
# Types of IDL that C++ lacks. Each header of types has them.
IDL_TYPES = """#ifndef TANDEM_IDL_TYPES
#define TANDEM_IDL_TYPES
namespace idl {
// A decimal number: "-12.34".
template <int digits, int scale>
using fixed = std::string;
// A value of any type: its signature, "d" for a double, and its CDR.
struct any {
    std::string type;
    std::vector<unsigned char> value;
};
inline std::string typeName(any*) { return "any"; }
inline void save_this(opros::archive::oarchive& ar, any& value) { ar << value.type << value.value; }
inline void load_this(opros::archive::iarchive& ar, any& value) { ar >> value.type >> value.value; }
}
#endif
"""


class NoCounterpart(Exception):
    """Why a type or an operation has no OPRoS form. The text is part of one line."""


def scoped(decl):
    return "::".join(decl.scopedName())


def member_types(decl):
    """Returns the member types of a structure or a union."""
    if isinstance(decl, idlast.Union):
        return [case.caseType() for case in decl.cases()]
    return [member.memberType() for member in decl.members()]


class Converter:
    """Finds the C++ type of an IDL type, if there is one."""

    def __init__(self):
        self.open = [] # the structures being converted, to detect those that contain themselves

    def cxx(self, t):
        kind = t.kind()
        if kind == idltype.tk_TypeCode:
            raise NoCounterpart("a TypeCode has no OPRoS counterpart")
        if kind in PRIMITIVES:
            return PRIMITIVES[kind]
        if kind == idltype.tk_fixed:
            return "idl::fixed<%d, %d>" % (t.digits(), t.scale())
        if kind == idltype.tk_sequence:
            return "std::vector<%s>" % self.cxx(t.seqType())
        decl = t.decl()
        if kind == idltype.tk_alias:
            if decl.sizes() or not self.is_plain(decl.alias().aliasType()):
                self.cxx(decl.alias().aliasType())
                return scoped(decl) if decl.sizes() else self.cxx(decl.alias().aliasType())
            return self.cxx(decl.alias().aliasType())
        if kind == idltype.tk_enum:
            return scoped(decl)
        if isinstance(decl, (idlast.StructForward, idlast.UnionForward)):
            decl = decl.fullDecl()
        if not isinstance(decl, (idlast.Struct, idlast.Union)):
            raise NoCounterpart("%s, a value type, has no OPRoS counterpart" % scoped(decl))
        if decl in self.open:
            raise NoCounterpart("%s contains itself" % scoped(decl))
        self.open.append(decl)
        try:
            for t in member_types(decl):
                self.cxx(t)
        finally:
            self.open.pop()
        return scoped(decl)

    @staticmethod
    def is_plain(t):
        return t.kind() in PRIMITIVES


CONVERTER = Converter()


def dimensions(sizes):
    return "".join("[%d]" % size for size in sizes)


def struct_lines(name, members):
    """`members` are (type, name, dimensions)."""
    lines = ["struct %s {" % name]
    for cxx, member, sizes in members:
        lines.append("    %s %s%s{};" % (cxx, member, sizes))
    fields = [member for _, member, _ in members]
    lines += ["};", 'inline std::string typeName(%s*) { return "%s"; }' % (name, name)]
    for function, archive, operator in [("save_this", "oarchive", "<<"), ("load_this", "iarchive", ">>")]:
        lines.append("inline void %s(opros::archive::%s& ar, %s& value) { ar%s; }" % (
            function, archive, name, "".join(" %s value.%s" % (operator, field) for field in fields)))
    return lines


def label_text(label):
    """Returns the C++ constant of a union case's label."""
    value = label.value()
    if isinstance(value, idlast.Enumerator):
        return scoped(value)
    if isinstance(value, str):
        return "char(%d)" % ord(value)
    return "static_cast<long long>(%dULL)" % value if value >= 1 << 63 else str(int(value))


def union_lines(name, discriminator, cases):
    """Returns a class whose archives hold the discriminator, named as in CORBA's C++ mapping, and the selected member.
    `cases` are (labels, type, name, dimensions). No labels: the default."""
    lines = ["struct %s {" % name, "    %s _d{};" % discriminator]
    lines += ["    %s %s%s{};" % (cxx, member, sizes) for _, cxx, member, sizes in cases]
    lines += ["};", 'inline std::string typeName(%s*) { return "%s"; }' % (name, name)]
    for function, archive, operator in [("save_this", "oarchive", "<<"), ("load_this", "iarchive", ">>")]:
        lines += ["inline void %s(opros::archive::%s& ar, %s& value) {" % (function, archive, name),
                  "    ar %s value._d;" % operator, "    switch (static_cast<long long>(value._d)) {"]
        for labels, _, member, _ in cases:
            lines += ["    case %s:" % label for label in labels] or ["    default:"]
            lines += ["        ar %s value.%s;" % (operator, member), "        break;"]
        lines += ["    }", "}"]
    return lines


def union_cases(decl):
    for case in decl.cases():
        d = case.declarator()
        labels = [] if any(label.default() for label in case.labels()) else [label_text(l) for l in case.labels()]
        yield labels, CONVERTER.cxx(case.caseType()), d.identifier(), dimensions(d.sizes())


class TypeWriter:
    """Collects the types of one file in IDL order."""

    def __init__(self):
        self.lines = []

    def in_namespaces(self, decl, lines):
        names = decl.scopedName()[:-1]
        if names:
            # Nested, because these headers are C++14.
            lines = [" ".join("namespace %s {" % name for name in names)] + lines + ["}" * len(names)]
        self.lines += lines + [""]

    def add(self, decl):
        try:
            if isinstance(decl, idlast.Struct):
                CONVERTER.cxx(decl_type(decl, idltype.tk_struct))
                members = [(CONVERTER.cxx(m.memberType()), d.identifier(), dimensions(d.sizes()))
                           for m in decl.members() for d in m.declarators()]
                self.in_namespaces(decl, struct_lines(decl.identifier(), members))
            elif isinstance(decl, idlast.Union):
                CONVERTER.cxx(decl_type(decl, idltype.tk_union))
                self.in_namespaces(decl, union_lines(decl.identifier(), CONVERTER.cxx(decl.switchType()),
                                                     list(union_cases(decl))))
            elif isinstance(decl, idlast.Enum):
                values = ", ".join(e.identifier() for e in decl.enumerators())
                self.in_namespaces(decl, ["enum %s { %s };" % (decl.identifier(), values)])
            elif isinstance(decl, idlast.Typedef):
                for d in decl.declarators():
                    cxx = CONVERTER.cxx(decl.aliasType())
                    if d.sizes(): # C++ passes no arrays: a structure of one member is encoded the same
                        self.in_namespaces(d, struct_lines(d.identifier(), [(cxx, "value", dimensions(d.sizes()))]))
                    else:
                        self.in_namespaces(d, ["typedef %s %s;" % (cxx, d.identifier())])
        except NoCounterpart:
            pass # the operations that use it report it


def decl_type(decl, kind):
    return idltype.declaredType(decl, decl.scopedName(), kind, 0)


def types_header(file):
    return os.path.splitext(os.path.basename(file))[0] + "Types.h"
