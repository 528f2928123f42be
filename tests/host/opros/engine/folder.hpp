// SPDX-License-Identifier: Apache-2.0
// A folder of profiles for one test.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

class Folder {
  public:
    Folder() {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("tandem_opros_" + std::to_string(getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name) << text;
        return path_ / name;
    }

    /// A component profile NAME.xml of the library; semantics is the inside of <execution_semantics>.
    void component(const std::string& name, const std::string& library,
                   const std::string& semantics = "<type>passive</type>",
                   const std::string& properties = "") const {
        write(name + ".xml", "<component_profile>\n<name>" + name +
                                 "</name>\n<execution_environment><library_name>" + library +
                                 "</library_name></execution_environment>\n<execution_semantics>" +
                                 semantics + "</execution_semantics>\n<properties>" + properties +
                                 "</properties>\n</component_profile>\n");
    }

    /// An application app.xml of these components; connections start in line 7.
    std::filesystem::path application(const std::string& components, const std::string& connections = "",
                                      const std::string& rest = "") const {
        return write("app.xml",
                     "<?xml version=\"1.0\" encoding=\"euc-kr\"?>\n<package_profile>\n<name>app</name>\n"
                     "<subcomponents>" +
                         components +
                         "</subcomponents>\n<!-- -->\n"
                         "<port_connections>\n" +
                         connections + "</port_connections>\n" + rest + "</package_profile>\n");
    }

    static std::string sub(const std::string& name, const std::string& reference,
                           const std::string& inside = "") {
        return "<subcomponent><name>" + name + "</name><reference>" + reference + "</reference>" + inside +
               "</subcomponent>";
    }
    static std::string connect(const std::string& type, const std::string& from, const std::string& from_port,
                               const std::string& to, const std::string& to_port) {
        return "<port_connection port_type=\"" + type + "\"><source component_name=\"" + from +
               "\" port_name=\"" + from_port + "\"/><target component_name=\"" + to + "\" port_name=\"" +
               to_port + "\"/></port_connection>\n";
    }

  private:
    std::filesystem::path path_;
};
