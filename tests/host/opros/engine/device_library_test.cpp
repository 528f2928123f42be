// SPDX-License-Identifier: Apache-2.0
// A component with a user's device library, which is found like component libraries.
#include "tests/host/opros/engine/running.hpp"

using tandem::engine::Application;

namespace {
std::filesystem::path sensing(const Folder& folder, const std::string& device) {
    folder.component("S", "sensing", "<type>passive</type>",
                     "<property name=\"ApiName\">" + device +
                         "</property><property name=\"scale\">4.5</property>");
    return folder.application(Folder::sub("S", "S.xml"));
}
} // namespace

TEST_CASE("a component opens a user's device library in each folder for component libraries") {
    const Folder folder;
    // The first is beside the profile, the others are on the plugin path.
    const std::string device = GENERATE("Beside.dll", "own_device", "own_device.dll", "libown_device.so");
    std::filesystem::copy_file(FIXTURES "/libown_device.so", folder.path() / "libBeside.so");
    Application application(sensing(folder, device), test_options(folder));
    application.start();
    application.step("S");
    application.step("S");
    CHECK(recorder(application, "S").executions == 2);
    CHECK(recorder(application, "S").last_number == 9);
    application.shut_down();
    CHECK(state(application, "S") == OPROS_CS_DESTROYED);
}

TEST_CASE("a missing or wrong device library makes its component fail with the component's own return code") {
    const Folder folder;
    const std::string device = GENERATE("nowhere", "maker");
    Application application(sensing(folder, device), test_options(folder));
    CHECK(application.find_component("S")->has_failed());
    CHECK(state(application, "S") == OPROS_CS_ERROR);
    CHECK(application.find_component("S")->component().getErrorInfo() ==
          (device == "nowhere" ? OPROS_FIND_DLL_ERROR : OPROS_LOAD_DLL_ERROR));
    CHECK_THROWS_AS(application.start(),
                    tandem::engine::SetupError); // the application has no other component
}

TEST_CASE("a component that cannot initialize says which device library or property it lacks") {
    const Folder folder;
    std::filesystem::create_directory(folder.path() / "devices");
    std::filesystem::copy_file(FIXTURES "/libown_device.so", folder.path() / "devices" / "SensingApi.so");
    const auto failure = [&](const std::string& properties) {
        folder.component("SensingComp", "sensing", "<type>passive</type>", properties);
        auto options = test_options(folder);
        options.plugin_dirs.push_back(folder.path() / "devices");
        Application application(folder.application(Folder::sub("S", "SensingComp.xml")), options);
        return application.find_component("S")->last_error();
    };
    CHECK(failure("<property name=\"ApiName\">nowhere</property>") ==
          "component S: onInitialize failed, it returned code 0x10000001 (OPROS_FIND_DLL_ERROR); device "
          "library "
          "'nowhere' of property ApiName does not exist; for a simulated device, set it to SensingApi");
    CHECK_THAT(failure("<property name=\"ApiName\">" + std::string(300, 'x') + "</property>"),
               Catch::Contains("returned code 0x10000001 (OPROS_FIND_DLL_ERROR); device library 'xxx"));
    CHECK(failure("<property name=\"Scale\">4.5</property>") ==
          "component S: onInitialize failed, it returned code 0x10000003 (OPROS_FIND_PROPERTY_ERROR); it "
          "asks for property ApiName, which SensingComp.xml lacks; for a simulated device, set it to "
          "SensingApi");
    CHECK(
        failure("<property name=\"ApiName\">own_device</property><property name=\"skale\">4.5</property>") ==
        "component S: onInitialize failed, it returned code 0x10000100 (OPROS_INITIALIZE_API_ERROR); it "
        "asks for property scale, which SensingComp.xml lacks; did you mean skale?");
    CHECK(failure("<property name=\"ApiName\">maker</property>") ==
          "component S: onInitialize failed, it returned code 0x10000002 (OPROS_LOAD_DLL_ERROR)");
}

TEST_CASE("a device library that the application names replaces the profile's under all of its names") {
    const Folder folder;
    folder.component("S", "sensing", "<type>passive</type>",
                     "<property name=\"DllName\">nowhere</property><property name=\"scale\">4.5</property>");
    Application application(
        folder.application(Folder::sub(
            "S", "S.xml", "<properties><property name=\"ApiName\">own_device</property></properties>")),
        test_options(folder));
    application.start();
    application.step("S");
    auto& component = application.find_component("S")->component();
    for (const char* name : {"APIName", "ApiName", "DllName"})
        CHECK_THAT(component.getProperty(name), Catch::EndsWith("/libown_device.so"));
}

TEST_CASE("a device library built against the headers of another Tandem is not given to its component") {
    const Folder folder;
    CHECK_THAT(setup_error(sensing(folder, "old_device"), test_options(folder)),
               Catch::Contains("S.xml") && Catch::Contains("ApiName old_device: library ") &&
                   Catch::Contains("was built against the headers of another Tandem"));
}
