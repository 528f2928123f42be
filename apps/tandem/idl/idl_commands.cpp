// SPDX-License-Identifier: Apache-2.0
// The command lines of `tandem idl2opros` and `tandem opros2idl`.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/commands.hpp"
#include "apps/tandem/idl/commands.hpp"

#include <memory>

namespace tandem::command {

void add_idl_commands(CLI::App& tandem, Action& selected) {
    auto to_opros = std::make_shared<Idl2OprosOptions>();
    CLI::App* command = add_command(
        tandem, "idl2opros",
        "Writes the OPRoS service profile and port headers for the interfaces of an IDL file",
        R"(For each interface I, writes IService.xml, II.h, IProvided.h and IRequired.h; for FILE and each included
file F with types, writes FTypes.h. Leaves out operations that have no counterpart in OPRoS and prints each
with the reason.
Exit code 1 if the IDL has errors.)");
    command->add_option("FILE", to_opros->file, "IDL file")->required();
    command->add_option("-o,--output", to_opros->folder, "folder to write to (.)")->type_name("DIR");
    command->add_option("-I,--include", to_opros->include_dirs, "folder with included IDL files (repeatable)")
        ->type_name("DIR")
        ->allow_extra_args(false);
    command->callback([=, &selected] { selected = [to_opros] { return idl2opros(*to_opros); }; });

    auto to_idl = std::make_shared<Opros2IdlOptions>();
    command = add_command(
        tandem, "opros2idl", "Writes the IDL for the services of an OPRoS service profile",
        R"(Arguments passed by a reference or pointer that is not const become inout, unless the profile says
otherwise. Non-blocking methods without a result and such arguments become oneway.
Exit code 1 if the profile is invalid, or if one of its types is neither a standard type nor defined in
a data type profile.)");
    command->add_option("FILE", to_idl->file, "service profile (XML)")->required();
    command->add_option("-o,--output", to_idl->output, "file to write (standard output)")->type_name("FILE");
    command->add_option("--types", to_idl->type_files, "data type profile (XML) (repeatable)")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command->callback([=, &selected] { selected = [to_idl] { return opros2idl(*to_idl); }; });
}

} // namespace tandem::command
