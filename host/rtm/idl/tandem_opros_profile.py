# SPDX-License-Identifier: Apache-2.0
"""The OPRoS profiles of the services and types of an IDL file. Part of tandem_opros.py.

In addition to the content of OPRoS profiles, they contain what only IDL knows and `tandem opros2idl` needs to restore
the IDL: the full name of an interface, `out` arguments, the exceptions of a method, and the methods that stand for an
attribute. The data type profile also contains enumerations, unions, exceptions and arrays.
"""
from omniidl import idlast, idltype

from tandem_opros_types import CONVERTER, NoCounterpart, dimensions, scoped

HEAD = '<?xml version="1.0" encoding="UTF-8"?>'


def xml_text(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")


def attributes(pairs):
    return "".join(' %s="%s"' % (name, xml_text(value)) for name, value in pairs if value)


def service_profile(interface, found):
    lines = [HEAD, "<service_port_type_profile>", "  <service_port_type>",
             "    <type_name%s>%s</type_name>" % (attributes([("idl", scoped(interface))]), interface.identifier())]
    for m in found:
        head = '    <method name="%s" return_type="%s" call_type="%s"%s' % (
            m.name, xml_text(m.result), "nonblocking" if m.oneway else "blocking",
            attributes([("attribute", m.attribute), ("raises", " ".join(m.raises))]))
        if not m.arguments:
            lines.append(head + "/>")
            continue
        lines.append(head + ">")
        for index, (cxx, argument) in enumerate(m.arguments, 1):
            lines.append('      <param index="%d"%s><type>%s</type><name>%s</name></param>' % (
                index, attributes([("direction", "out" if argument in m.outs else "")]), xml_text(cxx), argument))
        lines.append("    </method>")
    return "\n".join(lines + ["  </service_port_type>", "</service_port_type_profile>"]) + "\n"


def item(cxx, name, sizes, case=""):
    return '    <item%s>%s</item>' % (attributes([("type", cxx), ("size", dimensions(sizes)), ("case", case)]), name)


def label_text(label):
    """Returns an enumerator's full name or a character's number."""
    value = label.value()
    if isinstance(value, idlast.Enumerator):
        return scoped(value)
    return str(ord(value) if isinstance(value, str) else int(value))


class TypeProfile:
    """The data type profile of one file: the types that it declares, and the types that these and its interfaces use.
    Each type is declared before it is used."""

    def __init__(self):
        self.lines, self.known = [], set()

    def text(self):
        return "\n".join([HEAD, "<data_type>"] + self.lines + ["</data_type>"]) + "\n" if self.lines else None

    def use(self, t):
        """Adds the types that `t` consists of. They have a counterpart."""
        if t.kind() == idltype.tk_sequence:
            return self.use(t.seqType())
        if t.kind() == idltype.tk_objref or not isinstance(t, idltype.Declared):
            return None
        return self.add(t.decl())

    def add(self, decl):
        if isinstance(decl, idlast.Typedef):
            for d in decl.declarators():
                self.add(d)
            return
        if isinstance(decl, (idlast.StructForward, idlast.UnionForward)):
            decl = decl.fullDecl()
        name = scoped(decl)
        if name in self.known:
            return
        self.known.add(name)
        try:
            self.describe(decl, name)
        except NoCounterpart:
            pass # the operations that use it report it

    def element(self, kind, name, items, more=()):
        self.lines += ["  <%s%s>" % (kind, attributes([("name", name), *more]))] + items + ["  </%s>" % kind]

    def members(self, decl):
        for m in decl.members():
            cxx = CONVERTER.cxx(m.memberType())
            self.use(m.memberType())
            for d in m.declarators():
                yield item(cxx, d.identifier(), d.sizes())

    def describe(self, decl, name):
        if isinstance(decl, idlast.Enum):
            self.element("enum", name, ["    <item>%s</item>" % e.identifier() for e in decl.enumerators()])
        elif isinstance(decl, idlast.Struct):
            self.element("struct", name, list(self.members(decl)))
        elif isinstance(decl, idlast.Exception):
            self.element("exception", name, list(self.members(decl)))
        elif isinstance(decl, idlast.Union):
            self.use(decl.switchType())
            items = []
            for case in decl.cases():
                labels = case.labels()
                self.use(case.caseType())
                text = "default" if any(l.default() for l in labels) else " ".join(label_text(l) for l in labels)
                d = case.declarator()
                items.append(item(CONVERTER.cxx(case.caseType()), d.identifier(), d.sizes(), text))
            self.element("union", name, items, [("discriminator", CONVERTER.cxx(decl.switchType()))])
        elif isinstance(decl, idlast.Declarator): # of a typedef
            self.use(decl.alias().aliasType())
            if decl.sizes():
                cxx = CONVERTER.cxx(decl.alias().aliasType())
                self.element("struct", name, [item(cxx, "value", decl.sizes())], [("array", "yes")])
