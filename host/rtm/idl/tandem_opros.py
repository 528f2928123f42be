# SPDX-License-Identifier: Apache-2.0
"""omniidl back end: the OPRoS side of the interfaces of one IDL file.

`omniidl -p DIR -btandem_opros F.idl` writes, for each interface I of the file, IService.xml (the OPRoS service profile),
II.h (the interface), IProvided.h and IRequired.h (its ports), for the file and each that it includes FTypes.h with the
types, and for the file FTypes.xml, their OPRoS data type profile. What has no OPRoS counterpart is left out and named on
standard error, one line each: `F.idl: I.f: why`.
docs/joining.md says how operations and methods stand for each other.
"""
import os
import sys

from omniidl import idlast

from tandem_opros_profile import TypeProfile, service_profile
from tandem_opros_types import CONVERTER, NoCounterpart, TypeWriter, scoped, types_header

MAX_ARGUMENTS = 15
# Functions of every OPRoS port: a function of a required port that has such a name gets an underscore behind it.
PORT_FUNCTIONS = {"addMethod", "bindProvided", "getEnd", "getFirst", "getMethod", "getName", "getRole", "getType",
                  "isDynamic", "reset", "sample", "setName", "typeError"}
PROFILED = (idlast.Struct, idlast.Union, idlast.Enum, idlast.Typedef, idlast.Exception)
NOTE = "// Made by tandem idl2opros from %s; changes are lost when it is made again.\n#pragma once\n\n"


def direction(parameter):
    return "in" if not parameter.is_out() else "inout" if parameter.is_in() else "out"


def checked(t, what):
    try:
        return CONVERTER.cxx(t)
    except NoCounterpart as problem:
        raise NoCounterpart("%s: %s" % (what, problem))


class Method:
    def __init__(self, name, result, arguments, oneway=False):
        self.name, self.result, self.arguments, self.oneway = name, result, arguments, oneway
        self.types = []      # of IDL, result and exceptions included
        self.outs = set()    # arguments that are only written; a reference alone is inout
        self.raises = []     # names of exceptions
        self.attribute = "" # for which it stands

    def parameters(self):
        return ", ".join("%s %s" % argument for argument in self.arguments)

    def call_type(self):
        return "METHOD_NONBLOCKING" if self.oneway else "METHOD_BLOCKING"


def operation_method(operation):
    if len(operation.parameters()) > MAX_ARGUMENTS:
        raise NoCounterpart("%d arguments; OPRoS methods have %d at most"
                            % (len(operation.parameters()), MAX_ARGUMENTS))
    arguments = []
    for p in operation.parameters():
        cxx = checked(p.paramType(), "argument '%s'" % p.identifier())
        arguments.append((cxx + ("" if direction(p) == "in" else "&"), p.identifier()))
    method = Method(operation.identifier(), checked(operation.returnType(), "the result"), arguments,
                    operation.oneway())
    method.types = [operation.returnType()] + [p.paramType() for p in operation.parameters()]
    method.outs = {p.identifier() for p in operation.parameters() if direction(p) == "out"}
    method.raises = [scoped(exception) for exception in operation.raises()]
    return method


def attribute_methods(attribute, name):
    cxx = checked(attribute.attrType(), "attribute '%s'" % name)
    suffix = name[0].upper() + name[1:]
    found = [Method("get" + suffix, cxx, [])]
    if not attribute.readonly():
        found.append(Method("set" + suffix, "void", [(cxx, "value")]))
    for method in found:
        method.attribute, method.types = name, [attribute.attrType()]
    return found


def methods(interface, leave_out):
    """By name, those of the interfaces that it inherits included."""
    found = {}
    for base in interface.inherits():
        while isinstance(base, idlast.Declarator):
            base = base.alias().aliasType().decl()
        found.update(methods(base, leave_out))
    for callable_ in interface.callables():
        try:
            if isinstance(callable_, idlast.Attribute):
                for name in callable_.identifiers():
                    found.update((m.name, m) for m in attribute_methods(callable_, name))
            else:
                found[callable_.identifier()] = operation_method(callable_)
        except NoCounterpart as problem:
            name = callable_.identifiers()[0] if isinstance(callable_, idlast.Attribute) else callable_.identifier()
            leave_out(interface, name, problem)
    return found


def interface_header(note, file, name, found):
    lines = ['#include "%s"' % types_header(file), "", "class I%s {" % name, "  public:",
             "    virtual ~I%s() {}" % name]
    lines += ["    virtual %s %s(%s) = 0;" % (m.result, m.name, m.parameters()) for m in found]
    return note + "\n".join(lines + ["};"]) + "\n"


def provided_header(note, name, found):
    lines = ["#include <OPRoSTypes.h>", "#include <ProvidedMethod.h>", "#include <ProvidedServicePort.h>", "",
             '#include "I%s.h"' % name, "",
             "// Passes each call to the component, which derives from I%s." % name,
             "class %sProvided : public ProvidedServicePort {" % name, "  public:",
             "    explicit %sProvided(I%s* component) {" % (name, name)]
    for m in found:
        lines.append('        addMethod("%s", makeProvidedMethod(&I%s::%s, component, "%s", %s));'
                     % (m.name, name, m.name, m.name, m.call_type()))
    return note + "\n".join(lines + ["    }", "};"]) + "\n"


def required_header(note, name, found):
    port = name + "Required"
    lines = ["#include <OPRoSTypes.h>", "#include <RequiredMethod.h>", "#include <RequiredServicePort.h>", "",
             '#include "I%s.h"' % name, "",
             "// Each function calls the component that is connected. Throws MethodInvokeException.",
             "class %s : public RequiredServicePort {" % port, "  public:", "    %s() {" % port]

    def function(m):
        return m.name + ("_" if m.name in PORT_FUNCTIONS else "")

    for m in found:
        lines.append('        addMethod("%s", makeRequiredMethod(&%s::%s, "%s", %s));'
                     % (m.name, port, function(m), m.name, m.call_type()))
    lines.append("    }")
    for m in found:
        lines.append("    %s %s(%s) {" % (m.result, function(m), m.parameters()))
        lines.append('        return (*reinterpret_cast<RequiredMethod<%s>*>(getMethod("%s")))(%s);'
                     % (m.result, m.name, ", ".join(argument for _, argument in m.arguments)))
        lines.append("    }")
    return note + "\n".join(lines + ["};"]) + "\n"


class Collector:
    def __init__(self):
        self.types = {}    # by file, in the order of the IDL
        self.includes = {} # by file: those before it, which it may use
        self.interfaces = []
        self.profile = TypeProfile()

    def visit(self, declarations):
        for d in declarations:
            if isinstance(d, idlast.Module):
                self.visit(d.definitions())
            elif isinstance(d, idlast.Interface):
                self.visit(d.declarations())
                if d.mainFile():
                    self.interfaces.append(d)
            elif isinstance(d, (idlast.Struct, idlast.Union, idlast.Enum, idlast.Typedef)):
                self.types.setdefault(d.file(), TypeWriter()).add(d)
            if d.mainFile() and isinstance(d, PROFILED):
                self.profile.add(d)


def write(name, text):
    with open(name, "w") as out:
        out.write(text)


def run(tree, args):
    collector = Collector()
    collector.visit(tree.declarations())
    main_name = os.path.basename(tree.file())
    note = NOTE % main_name
    collector.types.setdefault(tree.file(), TypeWriter())
    before = []
    for file, writer in [(f, w) for f, w in collector.types.items() if f != tree.file()] + [
            (tree.file(), collector.types[tree.file()])]:
        includes = "".join('#include "%s"\n' % types_header(f) for f in before)
        write(types_header(file), note + "#include <OPRoSTypes.h>\n\n#include <string>\n#include <vector>\n" + includes
              + "\n" + "\n".join(writer.lines))
        before.append(file)
    left_out = 0

    def leave_out(interface, name, problem):
        nonlocal left_out
        left_out += 1
        sys.stderr.write("%s: %s.%s is left out: %s\n" % (main_name, scoped(interface), name, problem))

    total = 0
    for interface in collector.interfaces:
        found = [m for _, m in sorted(methods(interface, leave_out).items())]
        total += len(found)
        name = interface.identifier()
        for t in [t for m in found for t in m.types]:
            collector.profile.use(t)
        write(name + "Service.xml", service_profile(interface, found))
        write("I%s.h" % name, interface_header(note, tree.file(), name, found))
        write(name + "Provided.h", provided_header(note, name, found))
        write(name + "Required.h", required_header(note, name, found))
    if collector.profile.text():
        write(types_header(tree.file())[:-len(".h")] + ".xml", collector.profile.text())
    sys.stdout.write("%s: %d interfaces, %d methods, %d operations left out\n"
                     % (main_name, len(collector.interfaces), total, left_out))
