// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/examples.hpp"

#include <CLI/CLI.hpp>

#include <initializer_list>
#include <sstream>
#include <string>

namespace tandem::command {
namespace {

/// The examples of one command. tests/documentation looks up their options, and that each command has examples.
struct Examples {
    const char* command; ///< without `tandem`
    std::initializer_list<const char*> lines;
};

const Examples of_components[] = {
    {"opros info", {"tandem opros info Arm/Arm.xml", "tandem opros info Arm/Arm.so --initialize --json"}},
    {"opros check", {"tandem opros check robot/opros/robot.xml"}},
    {"opros new", {"tandem opros new Arm"}},
    {"opros build",
     {"tandem opros build Arm", "tandem opros build Camera --pkg-config opencv4 --standard 17"}},
    {"opros census", {"tandem opros census components", "tandem opros census components --json"}},
    {"opros import", {"tandem opros import /opt/opros --output robot --link robot"}},
    {"opros list", {"tandem opros list"}},
    {"opros start", {"tandem opros start Arm"}},
    {"opros stop", {"tandem opros stop Arm Camera"}},
    {"opros recover", {"tandem opros recover Adaptor && tandem opros start Adaptor"}},
    {"opros conf", {"tandem opros conf Arm", "tandem opros conf Arm gain=0.5"}},
    {"rtm new", {"tandem rtm new Gripper"}},
    {"rtm build", {"tandem rtm build Gripper", "tandem rtm build Gripper --build-type Debug"}},
    {"rtm census", {"tandem rtm census components", "tandem rtm census components --json"}},
    {"rtm import", {"tandem rtm import /opt/robot --output robot --link robot"}},
    {"rtm list", {"tandem rtm list", "tandem rtm list --manager 192.168.0.1:2810"}},
    {"rtm tree", {"tandem rtm tree"}},
    {"rtm info", {"tandem rtm info Gripper0"}},
    {"rtm activate", {"tandem rtm activate Gripper0"}},
    {"rtm deactivate", {"tandem rtm deactivate Gripper0"}},
    {"rtm reset", {"tandem rtm reset Gripper0 && tandem rtm activate Gripper0"}},
    {"rtm exit", {"tandem rtm exit Gripper0"}},
    {"rtm connect", {"tandem rtm connect Camera0:out Gripper0:in"}},
    {"rtm disconnect", {"tandem rtm disconnect Camera0:out Gripper0:in"}},
    {"rtm conf", {"tandem rtm conf Gripper0", "tandem rtm conf Gripper0 gain=0.5"}},
    {"rtm cat", {"tandem rtm cat Gripper0:out --count 10"}},
    {"rtm inject", {"tandem rtm inject Gripper0:in 1.5", "tandem rtm inject Gripper0:in 1 2 3 --rate 10"}},
    {"rtm record", {"tandem rtm record Gripper0:out --output gripper.mcap --duration 60"}},
    {"idl2opros", {"tandem idl2opros Camera.idl"}},
    {"opros2idl", {"tandem opros2idl Camera.xml"}},
    {"link profile", {"tandem link profile Arm Gripper --output robot"}},
    {"link check", {"tandem link check robot"}},
};

const Examples of_systems[] = {
    {"doctor", {"tandem doctor"}},
    {"run",
     {"tandem run robot", "tandem run robot --restart 5 --host-option=--lock-memory",
      "tandem run robot --lockstep --duration 10 --record run.mcap"}},
    {"system list", {"tandem system list", "tandem system list robots --json"}},
    {"system new", {"tandem system new robot Arm Gripper Gripper"}},
    {"system save", {"tandem system save robot-2", "tandem system save robot --replace"}},
    {"shm list", {"tandem shm list"}},
    {"shm info", {"tandem shm info robot"}},
    {"shm stats", {"tandem shm stats robot --watch 1"}},
    {"shm clean", {"tandem shm clean"}},
    {"echo", {"tandem echo robot out --count 10"}},
    {"hz", {"tandem hz robot"}},
    {"top", {"tandem top robot"}},
    {"graph", {"tandem graph"}},
    {"record", {"tandem record robot --output run.mcap --duration 60"}},
    {"replay", {"tandem replay run.mcap --link robot"}},
    {"bag info", {"tandem bag info run.mcap"}},
    {"bag cut", {"tandem bag cut run.mcap --from 10 --to 20 --output part.mcap"}},
    {"bag convert",
     {"tandem bag convert run.mcap --json",
      "tandem bag convert run.mcap --csv --topic /robot/out -o out.csv"}},
    {"bag check", {"tandem bag check run.mcap"}},
    {"monitor",
     {"tandem monitor", "tandem monitor --bind 0.0.0.0 --allow-host robot.local --control",
      "tandem monitor --control --systems robots"}},
    {"completion", {"source <(tandem completion bash)"}},
};

void add(CLI::App& tandem, const Examples& examples) {
    CLI::App* command = &tandem;
    std::istringstream words(examples.command);
    for (std::string word; words >> word;) command = command->get_subcommand(word);
    std::string text = command->get_footer() + "\n\nExamples:";
    // help2man leaves indented lines that begin with `$` as they are.
    for (const char* line : examples.lines) text += std::string("\n  $ ") + line;
    command->footer(text);
}

} // namespace

void add_examples(CLI::App& tandem) {
    for (const Examples& examples : of_components) add(tandem, examples);
    for (const Examples& examples : of_systems) add(tandem, examples);
}

} // namespace tandem::command
