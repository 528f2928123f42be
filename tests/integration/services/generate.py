# SPDX-License-Identifier: Apache-2.0
"""Writes the service matrix: `generate.py DIR` makes Matrix.idl, MatrixServant.h, MatrixCalls.h (the RTC's side),
MatrixOpros.h (the OPRoS component's) and MatrixCells.h (how many there are), in which each combination of shape and type is one operation.

Each side provides all operations and calls all of the other's; each checks every value that it gets. Values are made
from a seed by set() and compared by same(), which rtm_values.h and opros_values.h define for every type.
"""
import os
import sys


class Type:
    """One row of the matrix: how a type is called in IDL, by omniidl's C++ mapping, and in OPRoS."""

    def __init__(self, name, idl, kind, opros, cxx=None):
        self.name, self.idl, self.kind, self.opros = name, idl, kind, opros
        self.cxx = cxx or "Matrix::" + idl

    # The C++ mapping of IDL (OMG formal/2012-07-02, "Argument passing considerations").
    def parameter(self, direction):
        if self.kind == "string":
            wide = "W" if self.idl == "wstring" else ""
            character = self.cxx[:-1]
            return {"in": "const %s*" % character, "out": "CORBA::%sString_out" % wide,
                    "inout": character + "*&"}[direction]
        if direction == "inout":
            return self.cxx + "&"
        if direction == "out":
            return self.cxx + "_out"
        return self.cxx if self.kind == "primitive" else "const %s&" % self.cxx

    def returned(self):
        return self.cxx + "*" if self.kind == "variable" else self.cxx

    def variable(self):
        if self.kind == "string":
            return "CORBA::%sString_var" % ("W" if self.idl == "wstring" else "")
        return self.cxx + "_var" if self.kind == "variable" else self.cxx


TYPES = [
    Type("boolean", "boolean", "primitive", "bool", "CORBA::Boolean"),
    Type("char", "char", "primitive", "char", "CORBA::Char"),
    Type("octet", "octet", "primitive", "unsigned char", "CORBA::Octet"),
    Type("short", "short", "primitive", "short", "CORBA::Short"),
    Type("ushort", "unsigned short", "primitive", "unsigned short", "CORBA::UShort"),
    Type("long", "long", "primitive", "int", "CORBA::Long"),
    Type("ulong", "unsigned long", "primitive", "unsigned int", "CORBA::ULong"),
    Type("longlong", "long long", "primitive", "long", "CORBA::LongLong"),
    Type("ulonglong", "unsigned long long", "primitive", "unsigned long", "CORBA::ULongLong"),
    Type("float", "float", "primitive", "float", "CORBA::Float"),
    Type("double", "double", "primitive", "double", "CORBA::Double"),
    Type("string", "string", "string", "std::string", "char*"),
    Type("longdouble", "long double", "primitive", "long double", "CORBA::LongDouble"),
    Type("wchar", "wchar", "primitive", "wchar_t", "CORBA::WChar"),
    Type("wstring", "wstring", "string", "std::wstring", "CORBA::WChar*"),
    Type("mode", "Mode", "primitive", "Mode"),
    Type("price", "Price", "fixed", "std::string"),
    Type("any", "any", "variable", "Anything", "CORBA::Any"),
    Type("point", "Point", "fixed", "Point"),
    Type("label", "Label", "variable", "Label"),
    Type("choice", "Choice", "variable", "Choice"),
    Type("octets", "Octets", "variable", "std::vector<unsigned char>"),
    Type("doubles", "Doubles", "variable", "std::vector<double>"),
    Type("strings", "Strings", "variable", "std::vector<std::string>"),
    Type("labels", "Labels", "variable", "std::vector<Label>"),
    Type("rows", "Rows", "variable", "std::vector<std::vector<double>>"),
    Type("weights", "Weights", "variable", "std::map<std::string, double>"),
    Type("property", "Settings", "variable", "Property"),
]
BY_NAME = {t.name: t for t in TYPES}

IDL_TYPES = """  enum Mode { off, slow, fast };
  typedef fixed<6, 2> Price;
  struct Weight { string key; double value; };
  typedef sequence<Weight> Weights;
  struct Setting { string name; string value; };
  typedef sequence<Setting> Settings;
  struct Point { double x; long grid[3]; };
  struct Label { string text; Point place; boolean valid; };
  union Choice switch (long) { case 0: double number; case 1: string text; case 2: case 3: Point place; };
  typedef sequence<octet> Octets;
  typedef sequence<double> Doubles;
  typedef sequence<string> Strings;
  typedef sequence<Label> Labels;
  typedef sequence<Doubles> Rows;
  struct Tree;
  typedef sequence<Tree> Trees;
  struct Tree { long value; Trees branches; };
"""


class Operation:
    def __init__(self, name, arguments=(), result=None, raises=None, oneway=False, base=False):
        self.name, self.arguments, self.result = name, list(arguments), result
        self.raises, self.oneway, self.base = raises, oneway, base

    def idl(self):
        arguments = ", ".join("%s %s a%d" % (d, t.idl, i) for i, (d, t) in enumerate(self.arguments))
        return "    %s%s %s(%s)%s;" % ("oneway " if self.oneway else "", self.result.idl if self.result else "void",
                                      self.name, arguments,
                                      " raises (%s)" % self.raises if self.raises else "")


def matrix():
    operations = []
    for t in TYPES:
        operations += [Operation("in_" + t.name, [("in", t)]),
                       Operation("out_" + t.name, [("out", t)]),
                       Operation("inout_" + t.name, [("inout", t)]),
                       Operation("result_" + t.name, [], t, base=True),
                       Operation("raise_" + t.name, [], None, "E_" + t.name, base=True),
                       Operation("oneway_" + t.name, [("in", t)], None, None, True)]
    directions = ["in", "out", "inout"]
    for count in range(16):
        for direction in directions + ["mixed"]:
            if count == 0 and direction != "in":
                continue
            arguments = [(directions[i % 3] if direction == "mixed" else direction,
                          TYPES[(7 * count + i) % len(TYPES)]) for i in range(count)]
            result = TYPES[count % len(TYPES)] if direction == "mixed" else None
            operations.append(Operation("%s%d" % (direction, count), arguments, result))
    return operations


OPERATIONS = matrix()
ATTRIBUTES = TYPES
ANYS = 34 # tests/proxy/interceptor/anys_of_everything.hpp

# Values that cannot cross, and the CORBA system exception that the caller gets: (name, call, exception, whether it ran).
REFUSED_BY_RTM = [
    ("argument", "CORBA::Any_var(service->any_cell(0, false, tandem::test::any_of(TestTypes::Node())))", "NO"),
    ("string", "CORBA::String_var(service->refused_string())", "YES"),
    ("price", "service->refused_price()", "YES"),
    ("any", "CORBA::Any_var(service->refused_any())", "YES"),
]
REFUSED_BY_OPROS = [
    ("string", 'service.in_string(std::string("a\\0b", 3))', "BAD_PARAM"),
    ("wide_string", 'service.in_wstring(L"\\x1f916")', "BAD_PARAM"),
    ("wide_character", "service.in_wchar(static_cast<wchar_t>(0x1f916))", "BAD_PARAM"),
    ("price", 'service.in_price("1.234")', "BAD_PARAM"),
    ("enumerator", "service.in_mode(static_cast<Mode>(7))", "BAD_PARAM"),
    ("any", 'service.in_any({"((", {}})', "BAD_PARAM"),
    ("result", "service.refused_any()", "MARSHAL"),
]
EXPECTED_IN, EXPECTED_OUT, EXPECTED_RESULT, EXPECTED_FIELD, EXPECTED_ATTRIBUTE = 1, 21, 40, 50, 6


def write_idl():
    lines = ["module Matrix {", IDL_TYPES.rstrip()]
    lines += ["  exception E_%s { %s field; long code; };" % (t.name, t.idl) for t in TYPES]
    lines.append("  interface Base {")
    lines += [o.idl() for o in OPERATIONS if o.base]
    lines += ["    attribute %s at_%s;" % (t.idl, t.name) for t in ATTRIBUTES]
    lines.append("    readonly attribute long oneways;")
    lines.append("  };\n  interface Service : Base {")
    lines += [o.idl() for o in OPERATIONS if not o.base]
    lines.append("    any any_cell(in long number, in boolean make, in any value);")
    lines.append("    string refused_string();\n    Price refused_price();\n    any refused_any();")
    # What cannot cross must cost none of the others.
    lines.append("    void not_crossing(in Tree a);")
    lines.append("  };\n};")
    return "\n".join(lines) + "\n"


def check_and_set(o):
    """Statements that check what came in and write what goes out; true for both sides."""
    lines = []
    for i, (d, _) in enumerate(o.arguments):
        if d != "out":
            lines.append("require(same(a%d, %d));" % (i, EXPECTED_IN + i))
    for i, (d, _) in enumerate(o.arguments):
        if d != "in":
            lines.append("set(a%d, %d);" % (i, EXPECTED_OUT + i))
    return lines


def write_servant():
    lines = ["// Made by generate.py. What the RTC provides.", "class MatrixServant : public POA_Matrix::Service {", "  public:"]
    for o in OPERATIONS:
        parameters = ", ".join("%s a%d" % (t.parameter(d), i) for i, (d, t) in enumerate(o.arguments))
        body = []
        for i, (d, t) in enumerate(o.arguments):
            if d == "out" and t.kind == "variable":
                body.append("a%d = new %s;" % (i, t.cxx))
        body += check_and_set(o)
        if o.raises:
            t = BY_NAME[o.name[6:]]
            body += ["Matrix::%s e;" % o.raises, "set(e.field, %d);" % EXPECTED_FIELD, "e.code = 77;", "throw e;"]
        if o.oneway:
            body.append("++oneways_;")
        if o.result:
            body.append("return made<%s>(%d);" % (o.result.returned(), EXPECTED_RESULT))
        lines.append("    %s %s(%s) override { %s }" % (o.result.returned() if o.result else "void", o.name, parameters,
                                                       " ".join(body)))
    for t in ATTRIBUTES:
        lines.append("    %s at_%s() override { return copied<%s>(at_%s_); }" % (t.returned(), t.name, t.returned(), t.name))
        lines.append("    void at_%s(%s value) override { at_%s_ = value; }" % (t.name, t.parameter("in"), t.name))
    lines += ["    CORBA::Any* any_cell(CORBA::Long number, CORBA::Boolean make, const CORBA::Any& value) override {",
              "        const auto& expected = anys().at(static_cast<std::size_t>(number)).any;",
              "        require(make || tandem::test::is_same_any(expected, value));",
              "        return new CORBA::Any(expected);", "    }",
              '    char* refused_string() override { return CORBA::string_dup(""); }',
              "    Matrix::Price refused_price() override { return {}; }",
              "    CORBA::Any* refused_any() override { return new CORBA::Any(tandem::test::any_of(TestTypes::Node())); }",
              "    CORBA::Long oneways() override { return oneways_; }",
              "    void not_crossing(const Matrix::Tree&) override {}", "", "  private:",
              "    std::atomic<CORBA::Long> oneways_{0};"]
    lines += ["    %s at_%s_{};" % (t.variable() if t.kind == "string" else t.cxx, t.name) for t in ATTRIBUTES]
    return "\n".join(lines) + "\n};\n"


def call(o, target, pass_argument):
    """The expression of a call with the variables v0, v1, ..."""
    return "%s%s(%s)" % (target, o.name, ", ".join(pass_argument(i, d, t) for i, (d, t) in enumerate(o.arguments)))


def verify(o, expression, variable, result_variable):
    """A block that makes the arguments, calls, and checks what came back."""
    body = []
    for i, (d, t) in enumerate(o.arguments):
        body.append("%s v%d%s;" % (variable(t), i, "" if variable(t).endswith("_var") else "{}"))
        if d != "out":
            body.append("set(v%d, %d);" % (i, EXPECTED_IN + i))
        else:
            body.append("clear(v%d);" % i)
    if o.result:
        body.append("%s result = %s;" % (result_variable(o.result), expression))
        body.append("require(same(result, %d));" % EXPECTED_RESULT)
    else:
        body.append(expression + ";")
    for i, (d, _) in enumerate(o.arguments):
        if d != "in":
            body.append("require(same(v%d, %d));" % (i, EXPECTED_OUT + i))
    return " ".join(body)


def cell(name, block):
    """A cell of the matrix, which may throw a CORBA exception, too. It is not a separate function: some hundred would be compiled."""
    return '    try { %s cells.passed(); } catch (...) { cells.failed("%s"); }' % (block, name)


def write_rtm_calls():
    lines = ["// Made by generate.py. The RTC's calls of what it requires.",
             "inline void call_all(Matrix::Service_ptr service, Cells& cells) {"]

    def pass_argument(i, d, t):
        # Variables are _var for the types whose memory somebody owns.
        accessor = {"in": ".in()", "out": ".out()", "inout": ".inout()"}[d]
        return "v%d%s" % (i, accessor if t.kind in ("string", "variable") else "")

    for o in OPERATIONS:
        expression = call(o, "service->", pass_argument)
        if o.raises:
            block = ("try { %s; require(false); } catch (const Matrix::%s& e) { require(same(e.field, %d)); "
                     "require(e.code == 77); }" % (expression, o.raises, EXPECTED_FIELD))
        else:
            block = verify(o, expression, Type.variable, Type.variable)
        lines.append(cell(o.name, block))
    for t in ATTRIBUTES:
        accessor = ".in()" if t.kind in ("string", "variable") else ""
        block = ("%s v{}; set(v, %d); service->at_%s(v%s); %s back = service->at_%s(); require(same(back, %d));"
                 % (t.variable(), EXPECTED_ATTRIBUTE, t.name, accessor, t.variable(), t.name, EXPECTED_ATTRIBUTE))
        lines.append(cell("at_" + t.name, block))
    lines.append(cell("oneways", "require(eventually([&] { return service->oneways() >= %d; }));"
                      % sum(o.oneway for o in OPERATIONS)))
    lines.append(cell("not_crossing", "try { service->not_crossing(Matrix::Tree()); require(false); } "
                      "catch (const CORBA::SystemException&) {}"))
    lines += ["    require(anys().size() == MATRIX_ANYS);", "    for (CORBA::Long i = 0; i < MATRIX_ANYS; ++i) {",
              "        const auto& each = anys()[static_cast<std::size_t>(i)];",
              "        try { require(tandem::test::is_same_any(each.any, CORBA::Any_var(service->any_cell(i, false, each.any)).in()));",
              "            cells.passed(); } catch (...) { cells.failed(each.name); }", "    }"]
    for name, expression, ran in REFUSED_BY_RTM:
        lines.append(cell("refused_" + name, "try { %s; require(false); } catch (const CORBA::MARSHAL& e) { "
                          "require(e.completed() == CORBA::COMPLETED_%s); }" % (expression, ran)))
    return "\n".join(lines) + "\n}\n"


def opros_type(direction, t):
    """Out arguments are references here and inout arguments pointers, so that both are tried; `char*` would be text."""
    return t.opros + {"in": "", "out": "&", "inout": "&" if t.opros == "char" else "*"}[direction]


def opros_signature(o):
    return "%s %s(%s)" % (o.result.opros if o.result else "void", o.name,
                          ", ".join("%s a%d" % (opros_type(d, t), i) for i, (d, t) in enumerate(o.arguments)))


def opros_methods():
    """(name, result, parameters) of each method, attributes included."""
    methods = [(o.name, o.result.opros if o.result else "void",
                [opros_type(d, t) for d, t in o.arguments], o) for o in OPERATIONS]
    for t in ATTRIBUTES:
        methods.append(("getAt_" + t.name, t.opros, [], None))
        methods.append(("set_at_" + t.name, "void", [t.opros], None))
    methods.append(("get_oneways", "int", [], None))
    methods.append(("not_crossing", "void", ["int"], None))
    methods.append(("any_cell", "Anything", ["int", "bool", "Anything"], None))
    methods += [("refused_string", "std::string", [], None), ("refused_price", "std::string", [], None),
                ("refused_any", "Anything", [], None)]
    return methods


def write_opros():
    lines = ["// Made by generate.py. What the OPRoS component provides and how it calls what it requires.",
             "class IMatrix {", "  public:", "    virtual ~IMatrix() {}"]
    for name, result, parameters, _ in opros_methods():
        lines.append("    virtual %s %s(%s) = 0;" % (result, name, ", ".join(parameters)))
    lines += ["};", "", "class MatrixProvided : public ProvidedServicePort {", "  public:",
              "    explicit MatrixProvided(IMatrix* owner) {"]
    for name, _, _, _ in opros_methods():
        lines.append('        addMethod("%s", makeProvidedMethod(&IMatrix::%s, owner, "%s"));' % (name, name, name))
    lines += ["    }", "};", "", "class MatrixRequired : public RequiredServicePort {", "  public:",
              "    MatrixRequired() {"]
    for name, _, _, _ in opros_methods():
        lines.append('        addMethod("%s", makeRequiredMethod(&MatrixRequired::%s, "%s"));' % (name, name, name))
    lines.append("    }")
    for name, result, parameters, _ in opros_methods():
        declared = ", ".join("%s a%d" % (p, i) for i, p in enumerate(parameters))
        passed = ", ".join("a%d" % i for i in range(len(parameters)))
        lines.append('    %s %s(%s) { return (*reinterpret_cast<RequiredMethod<%s>*>(getMethod("%s")))(%s); }'
                     % (result, name, declared, result, name, passed))
    lines += ["};", "", "class MatrixService : public IMatrix {", "  public:"]
    for o in OPERATIONS:
        body = []
        for statement in check_and_set(o):
            body.append(statement)
        for i, (d, t) in enumerate(o.arguments):
            if opros_type(d, t).endswith("*"):
                body = [s.replace("(a%d," % i, "(*a%d," % i) for s in body]
        if o.raises:
            t = BY_NAME[o.name[6:]]
            body.append('throw MethodInvokeException("raised", "IDL:Matrix/%s:1.0", made<%s>(%d), 77);'
                        % (o.raises, t.opros, EXPECTED_FIELD))
        elif o.result:
            body.append("return made<%s>(%d);" % (o.result.opros, EXPECTED_RESULT))
        if o.oneway:
            body.append("++oneways_;")
        lines.append("    %s override { %s }" % (opros_signature(o), " ".join(body)))
    for t in ATTRIBUTES:
        lines.append("    %s getAt_%s() override { return at_%s_; }" % (t.opros, t.name, t.name))
        lines.append("    void set_at_%s(%s value) override { at_%s_ = value; }" % (t.name, t.opros, t.name))
    lines += ["    int get_oneways() override { return oneways_; }", "    void not_crossing(int) override {}",
              "    Anything any_cell(int, bool, Anything value) override { return value; }",
              '    std::string refused_string() override { return std::string("a\\0b", 3); }',
              '    std::string refused_price() override { return "1.234"; }',
              '    Anything refused_any() override { return {"?{nothing}", {}}; }', "",
              "  private:", "    std::atomic<int> oneways_{0};"]
    lines += ["    %s at_%s_{};" % (t.opros, t.name) for t in ATTRIBUTES]
    lines += ["};", "", "inline void call_all(MatrixRequired& service, Cells& cells) {"]
    for o in OPERATIONS:
        expression = call(o, "service.", lambda i, d, t: ("&" if opros_type(d, t).endswith("*") else "") + "v%d" % i)
        if o.raises:
            t = BY_NAME[o.name[6:]]
            block = ('try { %s; require(false); } catch (const MethodInvokeException& e) { '
                     'require(e.getId() == "IDL:Matrix/%s:1.0"); %s field{}; int code = 0; '
                     'require(e.getFields(field, code)); require(same(field, %d)); require(code == 77); }'
                     % (expression, o.raises, t.opros, EXPECTED_FIELD))
        else:
            block = verify(o, expression, lambda t: t.opros, lambda t: t.opros)
        lines.append(cell(o.name, block))
    for t in ATTRIBUTES:
        block = ("service.set_at_%s(made<%s>(%d)); require(same(service.getAt_%s(), %d));"
                 % (t.name, t.opros, EXPECTED_ATTRIBUTE, t.name, EXPECTED_ATTRIBUTE))
        lines.append(cell("at_" + t.name, block))
    lines.append(cell("oneways", "require(eventually([&] { return service.get_oneways() >= %d; }));"
                      % sum(o.oneway for o in OPERATIONS)))
    lines.append(cell("not_crossing", "try { service.not_crossing(1); require(false); } "
                      "catch (const MethodInvokeException& e) { require(!e.getId().empty()); }"))
    lines += ["    for (int i = 0; i < MATRIX_ANYS; ++i) {",
              "        try { service.any_cell(i, false, service.any_cell(i, true, {})); cells.passed(); }",
              '        catch (...) { cells.failed(("any " + std::to_string(i)).c_str()); }', "    }"]
    for name, expression, exception in REFUSED_BY_OPROS:
        lines.append(cell("refused_" + name, 'try { %s; require(false); } catch (const MethodInvokeException& e) { '
                          'require(e.getId() == "IDL:omg.org/CORBA/%s:1.0"); }' % (expression, exception)))
    return "\n".join(lines) + "\n}\n"


def main(directory):
    os.makedirs(directory, exist_ok=True)
    cells = len(OPERATIONS) + len(ATTRIBUTES) + 2 + ANYS
    for name, text in [("Matrix.idl", write_idl()), ("MatrixServant.h", write_servant()),
                       ("MatrixCalls.h", write_rtm_calls()), ("MatrixOpros.h", write_opros()),
                       ("MatrixCells.h", "#define MATRIX_ANYS %d\n#define MATRIX_CELLS_TO_RTM %d\n#define MATRIX_CELLS_TO_OPROS %d\n"
                        % (ANYS, cells + len(REFUSED_BY_OPROS), cells + len(REFUSED_BY_RTM)))]:
        with open(os.path.join(directory, name), "w") as out:
            out.write(text)


if __name__ == "__main__":
    main(sys.argv[1])
