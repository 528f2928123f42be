// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/apps/tandem/program.hpp"
#include "tests/host/opros/engine/folder.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tandem::test {

/// Runs `tandem opros build`.
inline Result build(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"opros", "build"});
    return tandem_program(std::move(arguments));
}

/// Writes a component in the style of v1: exported with a definition only, IComponent, the profile in a separate folder.
/// `body`: statements of its constructor.
inline void old_component(const Folder& folder, const std::string& body) {
    folder.write("neighbour/Gain.h", "inline double gain() { return 3; }\n");
    folder.write("Old/Old.cpp",
                 "#include <Component.h>\n#include <OPRoSTypes.h>\n#include <OutputDataPort.h>\n"
                 "#include \"Gain.h\"\n#include \"Helper.h\"\n"
                 "class Old : public Component {\n  OutputDataPort<double> out;\n public:\n"
                 "  Old() { addPort(\"out\", &out); " +
                     body +
                     " }\n  virtual ReturnType onExecute() { out.push(gain() * helped()); return "
                     "OPROS_SUCCESS; }\n};\n"
                     "#ifdef MAKE_COMPONENT_DLL\nextern \"C\" {\n"
                     "Component* getComponent() { return new Old; }\n"
                     "void releaseComponent(Component* com) { delete com; }\n}\n#endif\n");
    folder.write("Old/Helper.h", "double helped();\n");
    folder.write("Old/src/Helper.cpp", "#include \"Helper.h\"\ndouble helped() { return 2; }\n");
    folder.write("Old/mfc/Old.cpp", "#include <afxwin.h>\n");
    folder.component("Old/profile/Old", "Old.dll");
    folder.write("Old/profile/OldService.xml", "<service_port_type_profile/>");
}

} // namespace tandem::test
