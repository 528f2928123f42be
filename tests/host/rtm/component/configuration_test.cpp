// SPDX-License-Identifier: Apache-2.0
// Configuration sets of a component, configuration files, and the properties and strings of coil.
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace testing;

namespace {

/// The text of the error with which a component refuses the values; empty when it accepts them.
std::string refusal(SDOPackage::Configuration_ptr configuration, const SDOPackage::ConfigurationSet& set) {
    try {
        configuration->set_configuration_set_values(set);
        return "";
    } catch (const SDOPackage::InvalidParameter& error) {
        return static_cast<const char*>(error.description);
    }
}

} // namespace

TEST_CASE("A change of configuration is seen by onExecute one cycle later, never in the middle") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter?conf.fast.step=10");
    fixture.activate(counter);
    fixture.step(counter);
    CHECK(counter.value_.data == 1);

    SDOPackage::Configuration_var configuration = counter.get_configuration();
    SDOPackage::ConfigurationSetList_var sets = configuration->get_configuration_sets();
    REQUIRE(sets->length() == 2);
    CHECK(configuration->activate_configuration_set("fast"));
    CHECK(counter.step_ == 1);
    fixture.step(counter);
    CHECK(counter.value_.data == 2);
    CHECK(counter.step_ == 10);
    fixture.step(counter);
    CHECK(counter.value_.data == 12);

    SDOPackage::ConfigurationSet_var active = configuration->get_active_configuration_set();
    CHECK(std::string(active->id) == "fast");
    coil::Properties change;
    change.setProperty("step", "no number");
    NVUtil::copyFromProperties(active->configuration_data, change);
    CHECK(refusal(configuration.in(), active.in()) == "step is no number, expected a whole number (int)");
    CORBA::Any text;
    text <<= "3";
    CHECK(configuration->set_configuration_parameter("step", text));
    for (const char* wrong : {"many", "4 m", "4,5"}) {
        text <<= wrong;
        CHECK_THROWS_AS(configuration->set_configuration_parameter("step", text),
                        SDOPackage::InvalidParameter);
    }
    fixture.step(counter);
    CHECK(counter.step_ == 3);
    CHECK_THROWS_AS(configuration->activate_configuration_set("none"), SDOPackage::InvalidParameter);
}

TEST_CASE("A value is refused by the type of the variable, unless the component converts it itself") {
    struct Arm : Counter {
        explicit Arm(RTC::Manager* manager) : Counter(manager) {}
        RTC::ReturnCode_t onInitialize() override {
            bindParameter("speed", speed, "0.5");
            bindParameter("enabled", enabled, "yes");
            bindParameter("limits", limits, "1,2");
            bindParameter("angle", angle, "90deg", from_degrees);
            bindParameter("turn", turn, "90", in_words);
            return Counter::onInitialize();
        }
        static bool from_degrees(int& value, const char* text) {
            value = std::atoi(text);
            return std::string(text).find("deg") != std::string::npos;
        }
        static bool in_words(int& value, const char* text) {
            value = std::string(text) == "back" ? 180 : 90;
            return true;
        }
        int turn = 0;
        double speed = 0;
        bool enabled = false;
        std::vector<double> limits;
        int angle = 0;
    };
    ManagerFixture fixture;
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "Arm");
    fixture.manager().registerFactory(profile, RTC::Create<Arm>, RTC::Delete<Arm>);
    auto& arm = fixture.create<Arm>("Arm?conf.default.speed=fast");
    CHECK(arm.speed == 0.5);
    SDOPackage::Configuration_var configuration = arm.get_configuration();
    SDOPackage::ConfigurationSet_var shown = configuration->get_configuration_set("default");
    CHECK(NVUtil::toString(shown->configuration_data, "speed") == std::string("0.5")); // what it uses
    const auto set_to = [&](const char* name, const char* value) {
        SDOPackage::ConfigurationSet change;
        change.id = CORBA::string_dup("default");
        coil::Properties values;
        values.setProperty(name, value);
        NVUtil::copyFromProperties(change.configuration_data, values);
        return refusal(configuration.in(), change);
    };
    CHECK(set_to("speed", "abc") == "speed is abc, expected a number (double)");
    CHECK(set_to("enabled", "maybe") == "enabled is maybe, expected true or false (bool)");
    CHECK(set_to("limits", "1,x") == "limits is 1,x, expected numbers separated by commas (double)");
    CHECK(set_to("speed", "1.5").empty());
    CHECK(set_to("speed", "fast") == "speed is fast, expected a number (double)");
    CHECK(set_to("angle", "45deg").empty());
    CHECK(set_to("angle", "wide").empty()); // nobody but the component can tell
    CHECK(set_to("turn", "back").empty());  // even if the default is a number
    fixture.activate(arm);
    fixture.step(arm);
    CHECK(arm.speed == 1.5);
    CHECK(arm.enabled);
}

TEST_CASE("A parameter that the profile does not mention is listed with its default and can be set") {
    struct Undeclared : Counter {
        explicit Undeclared(RTC::Manager* manager) : Counter(manager) {}
        RTC::ReturnCode_t onInitialize() override {
            bindParameter("greeting", greeting, "hello");
            return Counter::onInitialize();
        }
        std::string greeting;
    };
    ManagerFixture fixture;
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "Undeclared");
    fixture.manager().registerFactory(profile, RTC::Create<Undeclared>, RTC::Delete<Undeclared>);
    auto& component = fixture.create<Undeclared>("Undeclared");
    SDOPackage::Configuration_var configuration = component.get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set("default");
    coil::Properties listed = NVUtil::toProperties(set->configuration_data);
    CHECK(listed.getProperty("greeting") == "hello");
    CHECK(listed.getProperty("step") == "1");
    fixture.activate(component);
    fixture.step(component);
    CHECK(component.greeting == "hello");
    CHECK(component.value_.data == 1);
    listed.setProperty("greeting", "bye");
    NVUtil::copyFromProperties(set->configuration_data, listed);
    CHECK(configuration->set_configuration_set_values(set.in()));
    fixture.step(component);
    CHECK(component.greeting == "bye");
}

TEST_CASE(
    "A parameter with dots in its name reaches its variable from the profile, from rtc.conf and from tools") {
    struct Gains : Counter {
        explicit Gains(RTC::Manager* manager) : Counter(manager) {}
        RTC::ReturnCode_t onInitialize() override {
            bindParameter("pdgains.file_name", file, "bound.dat");
            bindParameter("pdgains", parent, "3");
            bindParameter("limits.upper", upper, "1");
            return Counter::onInitialize();
        }
        std::string file;
        int parent = 0;
        double upper = 0;
    };
    ManagerFixture fixture;
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "Gains");
    profile.setDefault("conf.default.pdgains.file_name", "profile.dat");
    fixture.manager().registerFactory(profile, RTC::Create<Gains>, RTC::Delete<Gains>);
    auto& gains = fixture.create<Gains>("Gains?conf.default.limits.upper=0.5");
    CHECK(gains.file == "profile.dat");
    CHECK(gains.parent == 3);
    CHECK(gains.upper == 0.5);
    SDOPackage::Configuration_var configuration = gains.get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set("default");
    coil::Properties listed = NVUtil::toProperties(set->configuration_data);
    CHECK(listed.getProperty("pdgains") == "3");
    listed.setProperty("pdgains.file_name", "tool.dat");
    NVUtil::copyFromProperties(set->configuration_data, listed);
    CHECK(refusal(configuration.in(), set.in()).empty());
    CORBA::Any text;
    text <<= "4";
    CHECK(configuration->set_configuration_parameter("pdgains", text));
    text <<= "high";
    CHECK_THROWS_AS(configuration->set_configuration_parameter("limits.upper", text),
                    SDOPackage::InvalidParameter);
    fixture.activate(gains);
    fixture.step(gains);
    CHECK(gains.file == "tool.dat");
    CHECK(gains.parent == 4);
    CHECK(gains.upper == 0.5);
}

namespace {

/// A temporary file with this text.
struct ConfFile {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("tandem_conf_test." + std::to_string(getpid()));
    explicit ConfFile(const std::string& text) { std::ofstream(path) << text; }
    ~ConfFile() { std::filesystem::remove(path); }
};

} // namespace

TEST_CASE("A configuration file has keys, comments and continued lines") {
    ConfFile file("# comment\n! comment\n\nmanager.modules.preload: A.so, \\\n  B.so\r\ncorba.nameservers:\n "
                  " x.y = 3 \n");
    coil::Properties conf;
    RTC::read_conf_file(file.path, conf);
    CHECK(conf.getProperty("manager.modules.preload") == "A.so, B.so");
    CHECK(conf.getProperty("corba.nameservers").empty());
    CHECK(conf.getProperty("x.y") == "3");
}

TEST_CASE("A line that is not a setting is refused with file and line") {
    ConfFile file("a: 1\n\nwithout a separator\n");
    coil::Properties conf;
    CHECK_THROWS_WITH(RTC::read_conf_file(file.path, conf),
                      Catch::Contains(file.path.string() + ":3: ") && Catch::Contains("without a separator"));
    CHECK_THROWS_WITH(RTC::read_conf_file("/no/such/file", conf), Catch::Contains("cannot be read"));
}

TEST_CASE("A component's own file and the arguments of its creation configure it, and the arguments win") {
    ConfFile file("conf.default.step: 5\nexec_cxt.periodic.rate: 33\n");
    ManagerFixture fixture(true, {"test.Counter.config_file:" + file.path.string()});
    auto& one = fixture.create<Counter>("Counter");
    auto& two = fixture.create<Counter>("Counter?step=7");
    CHECK(one.step_ == 5);
    CHECK(two.step_ == 7);
    CHECK(one.getExecutionRate(0) == 33);
    CHECK_THROWS_WITH(fixture.create<Counter>("Counter?step"), Catch::Contains("key=value"));
    CHECK_THROWS_WITH(fixture.create<Counter>("Cuonter"),
                      Catch::Contains("known: ") && Catch::Contains("Counter"));
}

TEST_CASE("A component whose configuration file does not exist keeps its defaults") {
    ManagerFixture fixture(
        true, {"test.Counter.config_file:not_handed_on.conf", "test.Counter0.config_file:nor_this.conf"});
    CHECK(fixture.create<Counter>("Counter").step_ == 1);
}

TEST_CASE("Properties are a tree with defaults") {
    const char* const spec[] = {"name", "X", "conf.default.gain", "2", "conf.default.mode", "a.b", ""};
    coil::Properties p(spec);
    CHECK(p["name"] == "X");
    CHECK(p.getProperty("conf.default.gain") == "2");
    CHECK(p.getProperty("conf.default.none", "other") == "other");
    CHECK(p.findNode("conf.none") == nullptr);
    CHECK(p.getNode("conf.default").size() == 2);
    p.setDefault("conf.default.mode.shown", "c");
    CHECK(p.getNode("conf.default").propertyNames() == coil::vstring{"gain", "mode", "mode.shown"});
    p["conf.default.gain"] = "3";
    coil::Properties q;
    q.setProperty("conf.default.gain", "4");
    q.setProperty("new", "5");
    p << q;
    CHECK(p.getProperty("conf.default.gain") == "4");
    CHECK(p.getProperty("conf.default.mode") == "a.b");
    CHECK(p.getProperty("new") == "5");
    coil::Properties copy(p);
    p.clear();
    CHECK(copy.getProperty("conf.default.gain") == "4");
    std::ostringstream out;
    copy.store(out, "header");
    std::istringstream in(out.str());
    coil::Properties back;
    back.load(in);
    CHECK(back.propertyNames() == copy.propertyNames());
}

TEST_CASE("Strings are split, trimmed and converted as component sources expect") {
    CHECK(coil::split(" a, b ,,c", ",") == coil::vstring{"a", "b", "", "c"});
    CHECK(coil::split("a,,c", ",", true) == coil::vstring{"a", "c"});
    CHECK(coil::split("", ",").empty());
    CHECK(coil::eraseBothEndsBlank("  x y\t\r") == "x y");
    CHECK(coil::toBool("yes", "YES", "NO", false));
    CHECK_FALSE(coil::toBool("no", "YES", "NO", true));
    CHECK(coil::toBool("?", "YES", "NO", true));
    CHECK(coil::urlparam2map("x?a=1&b=&c").at("a") == "1");
    CHECK(coil::parseArgs("a \"b c\" d") == coil::vstring{"a", "b c", "d"});
    CHECK(coil::replaceString("a%%a", "%", "%%") == "a%%%%a");
    CHECK(coil::sprintf("%s %03d", "n", 7) == "n 007");
    double d = 0;
    CHECK(coil::stringTo(d, "2.5"));
    CHECK_FALSE(coil::stringTo(d, "two"));
    std::vector<int> v;
    CHECK(coil::stringTo(v, "1, 2,3"));
    CHECK(v == std::vector<int>{1, 2, 3});
    bool b = false;
    CHECK((coil::stringTo(b, "ON") && b));
}

TEST_CASE("The active set is that of configuration.active_config, and descriptions of parameters are passed "
          "through") {
    ManagerFixture fixture;
    auto& counter =
        fixture.create<Counter>("Counter?conf.fast.step=10&configuration.active_config=fast"
                                "&conf.__widget__.step=slider.1&conf.__constraints__.step=0<=x<=10");
    CHECK(counter.step_ == 10);
    SDOPackage::Configuration_var configuration = counter.get_configuration();
    SDOPackage::ConfigurationSet_var active = configuration->get_active_configuration_set();
    CHECK(std::string(active->id) == "fast");
    SDOPackage::ConfigurationSetList_var sets = configuration->get_configuration_sets();
    CHECK(sets->length() == 2);
    SDOPackage::ConfigurationSet_var widgets = configuration->get_configuration_set("__widget__");
    CHECK(NVUtil::toString(widgets->configuration_data, "step") == "slider.1");
    RTC::ComponentProfile_var profile = counter.get_component_profile();
    CHECK(NVUtil::toString(profile->properties, "conf.__constraints__.step") == "0<=x<=10");
    CHECK_THROWS_AS(configuration->activate_configuration_set("__widget__"), SDOPackage::InvalidParameter);
    auto& other = fixture.create<Counter>("Counter?configuration.active_config=none");
    CHECK(other.step_ == 1);
}

namespace {

/// A listener of all three kinds that appends each call to a text.
struct Heard : RTC::ConfigurationParamListener,
               RTC::ConfigurationSetListener,
               RTC::ConfigurationSetNameListener {
    explicit Heard(std::string& s, const char* w) : calls(s), what(w) {}
    void operator()(const char* set, const char* param) override {
        calls += what + "(" + set + "." + param + ") ";
    }
    void operator()(const coil::Properties& set) override { calls += what + "(" + set.getName() + ") "; }
    void operator()(const char* set) override { calls += what + "(" + set + ") "; }
    std::string& calls;
    std::string what;
};

} // namespace

TEST_CASE("Listeners are called for sets that are added, set, activated and removed, and for parameters that "
          "change") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    std::string calls;
    Heard changed(calls, "changed"), set(calls, "set"), added(calls, "added"), updated(calls, "updated"),
        removed(calls, "removed"), activated(calls, "activated");
    counter.addConfigurationParamListener(RTC::ON_UPDATE_CONFIG_PARAM, &changed, false);
    counter.addConfigurationSetListener(RTC::ON_SET_CONFIG_SET, &set, false);
    counter.addConfigurationSetListener(RTC::ON_ADD_CONFIG_SET, &added, false);
    counter.addConfigurationSetNameListener(RTC::ON_UPDATE_CONFIG_SET, &updated, false);
    counter.addConfigurationSetNameListener(RTC::ON_REMOVE_CONFIG_SET, &removed, false);
    counter.addConfigurationSetNameListener(RTC::ON_ACTIVATE_CONFIG_SET, &activated, false);
    SDOPackage::Configuration_var configuration = counter.get_configuration();
    SDOPackage::ConfigurationSet fresh;
    fresh.id = CORBA::string_dup("fresh");
    coil::Properties values;
    values.setProperty("step", "3");
    NVUtil::copyFromProperties(fresh.configuration_data, values);
    CHECK(configuration->add_configuration_set(fresh));
    CHECK(configuration->activate_configuration_set("fresh"));
    CHECK(std::exchange(calls, "") == "added(fresh) activated(fresh) ");
    fixture.activate(counter);
    CHECK(std::exchange(calls, "") == "changed(fresh.step) updated(fresh) ");
    fixture.step(counter);
    CHECK(counter.getConfigService().changedParameters().empty()); // the last cycle changed none
    CHECK(configuration->set_configuration_set_values(fresh));
    fixture.step(counter);
    CHECK(std::exchange(calls, "") == "set(fresh) updated(fresh) ");
    CHECK(configuration->activate_configuration_set("default"));
    CHECK(configuration->remove_configuration_set("fresh"));
    CHECK(calls == "activated(default) removed(fresh) ");
}

TEST_CASE("An update that a listener ends with an exception is repeated") {
    struct Thrower : RTC::ConfigurationSetNameListener {
        void operator()(const char*) override {
            if (++calls == 1) throw std::runtime_error("not now");
        }
        int calls = 0;
    } listener;
    coil::Properties sets;
    RTC::ConfigAdmin admin(sets);
    int step = 0;
    admin.bindParameter("step", step, "1");
    admin.update();
    admin.addConfigurationSetNameListener(RTC::ON_UPDATE_CONFIG_SET, &listener, false);
    CHECK(admin.activateConfigurationSet("default"));
    CHECK_THROWS_WITH(admin.update(), "not now");
    admin.update();
    admin.update();
    CHECK(listener.calls == 2);
}

namespace {

// An Accumulator whose profile has no parameters.
Accumulator& create_bare(ManagerFixture& fixture, const std::string& arguments) {
    coil::Properties profile;
    for (const char* key : {"implementation_id", "type_name"}) profile.setProperty(key, "Bare");
    fixture.manager().registerFactory(profile, RTC::Create<Accumulator>, RTC::Delete<Accumulator>);
    return fixture.create<Accumulator>("Bare" + arguments);
}

} // namespace

TEST_CASE("A component without parameters has the set default, which tools list, read and activate") {
    ManagerFixture fixture;
    SDOPackage::Configuration_var configuration = create_bare(fixture, "").get_configuration();
    SDOPackage::ConfigurationSetList_var sets = configuration->get_configuration_sets();
    REQUIRE(sets->length() == 1);
    CHECK(std::string(sets[0].id) == "default");
    SDOPackage::ConfigurationSet_var set = configuration->get_configuration_set("default");
    CHECK(set->configuration_data.length() == 0);
    set = configuration->get_active_configuration_set();
    CHECK(std::string(set->id) == "default");
    CHECK(configuration->set_configuration_set_values(set.in()));
    CHECK(configuration->activate_configuration_set("default"));
}

TEST_CASE("A component that has only other sets has the set default as well") {
    ManagerFixture fixture;
    SDOPackage::Configuration_var configuration =
        create_bare(fixture, "?conf.fast.gain=2").get_configuration();
    SDOPackage::ConfigurationSet_var set = configuration->get_active_configuration_set();
    CHECK(std::string(set->id) == "default");
    CHECK(configuration->activate_configuration_set("fast"));
    CHECK(configuration->activate_configuration_set("default"));
}

TEST_CASE("Values for a set that does not exist create it, and its name has no dots") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    SDOPackage::Configuration_var configuration = counter.get_configuration();
    SDOPackage::ConfigurationSet fresh;
    fresh.id = CORBA::string_dup("fresh");
    coil::Properties values;
    values.setProperty("step", "three");
    NVUtil::copyFromProperties(fresh.configuration_data, values);
    CHECK_THROWS_AS(configuration->set_configuration_set_values(fresh),
                    SDOPackage::InvalidParameter); // and creates no set
    CHECK_THROWS_AS(configuration->activate_configuration_set("fresh"), SDOPackage::InvalidParameter);
    values.setProperty("step", "3");
    NVUtil::copyFromProperties(fresh.configuration_data, values);
    CHECK(configuration->set_configuration_set_values(fresh));
    CHECK(configuration->activate_configuration_set("fresh"));
    REQUIRE(fixture.activate(counter) == RTC::RTC_OK);
    CHECK(counter.step_ == 3);
    for (const char* wrong : {"", "fresh.er"}) {
        fresh.id = CORBA::string_dup(wrong);
        CHECK_THROWS_AS(configuration->set_configuration_set_values(fresh), SDOPackage::InvalidParameter);
    }
    CHECK(configuration->activate_configuration_set("default"));
    CHECK(configuration->remove_configuration_set("fresh"));
}
