// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/include_scan.hpp"
#include "apps/tandem/build/folder/checkout.hpp"
#include "apps/tandem/build/folder/project_files.hpp"
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/build/packages/header_packages.hpp"
#include "apps/tandem/output/print.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <utility>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

// Returns the names in #include lines, in all branches of the preprocessor.
std::vector<std::string> included_names(const fs::path& file) {
    std::istringstream stream(strip_comments(read_text(file)));
    std::vector<std::string> names;
    for (std::string line; std::getline(stream, line);) {
        const auto hash = line.find_first_not_of(" \t");
        if (hash == std::string::npos || line[hash] != '#') continue;
        const auto word = line.find_first_not_of(" \t", hash + 1);
        if (word == std::string::npos || line.compare(word, 7, "include") != 0) continue;
        const auto begin = line.find_first_of("\"<", word);
        const auto end = begin == std::string::npos ? begin : line.find_first_of("\">", begin + 1);
        if (end != std::string::npos) names.push_back(line.substr(begin + 1, end - begin - 1));
    }
    return names;
}

bool declares_interface(const fs::path& idl) {
    std::string text = strip_comments(read_text(idl));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '{' || c == '}' || c == ';'; }, ' ');
    std::istringstream words(text);
    return std::find(std::istream_iterator<std::string>(words), {}, "interface") !=
           std::istream_iterator<std::string>();
}

class Scanner {
  public:
    Scanner(const fs::path& folder, const Paths& sources, const Paths& include_dirs,
            const NeighbourHeaders& neighbours)
        : folder_(fs::canonical(folder)), dirs_(include_dirs), found_(list_files_below(folder_)),
          neighbours_(neighbours) {
        for (const char* place : {".", "include", "src"})
            dirs_.push_back((folder_ / place).lexically_normal());
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder_ / "include", ignored))
            dirs_.push_back(entry.path());
        for (const auto& source : sources) places_.insert(source.parent_path());
        for (const auto& place : std::set<fs::path>(places_)) add_project_dirs(place);
        add_project_dirs(folder_);
    }

    void read(const fs::path& file) {
        if (!visited_.insert(file).second) return;
        for (const auto& name : included_names(file)) resolve(name, file.parent_path());
    }

    IncludeScan result;

  private:
    // Files of these folders have the lowest precedence, so that the order of the folders does not matter.
    void add_project_dirs(const fs::path& place) {
        for (const auto& dir : read_include_dirs(place))
            if (!has_upstream_api(dir))
                for (const auto& file : list_files(dir))
                    if (std::find(found_.begin(), found_.end(), file) == found_.end()) found_.push_back(file);
    }

    void resolve(const std::string& name, const fs::path& place) {
        if (is_old_opencv_header(name)) result.old_opencv = true;
        const auto in_search_path = find_in_dirs(name, place);
        if (in_search_path.empty() || in_search_path.string().starts_with("/usr/")) add_module(name);
        if (!in_search_path.empty()) return read(in_search_path);
        if (result.forwards.count(name) != 0) return;
        auto file = find_below(name);
        if (const auto neighbour = neighbour_of(name); file.empty() && !is_idl(neighbour)) file = neighbour;
        if (const auto beside = (place / to_posix_path(name)).lexically_normal();
            file.empty() && is_file(beside))
            file = beside;
        if (file.empty()) return find_otherwise(name, place);
        result.forwards[name] = file.string();
        read(file);
    }

    fs::path find_in_dirs(const std::string& name, const fs::path& place) const {
        if (is_file(place / name)) return (place / name).lexically_normal();
        for (const auto& dir : dirs_)
            if (is_file(dir / name)) return (dir / name).lexically_normal();
        return {};
    }

    fs::path neighbour_of(const std::string& name) const {
        const auto found = neighbours_.find(name);
        return found == neighbours_.end() ? fs::path{} : found->second;
    }

    void add_module(const std::string& name) {
        const auto package = find_package_of_header(name);
        if (package && package->certain && !package->pkg_config.empty())
            result.pkg_config.insert(std::string(package->pkg_config));
    }

    // Headers of OpenRTM are in folders with a version, openrtm-1.1/rtm/RTC.h; those of Windows users have backslashes,
    // and drives: C:\Eigen\include\Eigen\Core.
    void find_otherwise(const std::string& name, const fs::path& place) {
        static const std::regex on_drive("[A-Za-z]:/(?:(?:.*/)?include/|.*/)?(.+)"),
            versioned("(?:openrtm|rtm|coil)-[0-9.]+/(.+)");
        std::smatch found;
        std::string meant = to_posix_path(name);
        for (const auto* form : {&on_drive, &versioned})
            if (const std::string path = meant; std::regex_match(path, found, *form)) meant = found[1].str();
        if (auto skeleton = skeleton_without_services(name); !skeleton.empty()) meant = std::move(skeleton);
        if (meant == name) {
            result.unknown.insert(name);
            return find_idl(name);
        }
        result.forwards[name] = meant;
        resolve(meant, place);
    }

    // Components that RTCBuilder makes for tests include XSVC_impl.h, the implementation of services, even for an X.idl that
    // only has data types. Returns the header with the types.
    std::string skeleton_without_services(const std::string& name) const {
        static const std::string implementation = "SVC_impl.h";
        static const std::set<std::string> of_openrtm{"BasicDataType", "ExtendedDataTypes",
                                                      "InterfaceDataTypes"};
        if (!name.ends_with(implementation)) return "";
        const std::string base = name.substr(0, name.size() - implementation.size());
        if (of_openrtm.count(base) != 0) return "rtm/idl/" + base + "Skel.h";
        const auto idl = idl_file("", base + ".idl");
        return idl.empty() || declares_interface(idl) ? "" : base + "Skel.h";
    }

    // Returns the file whose path ends with the name, preferably in the same case.
    fs::path find_below(const std::string& name) const {
        std::string end = to_posix_path(name);
        while (end.rfind("../", 0) == 0 || end.rfind("./", 0) == 0) end.erase(0, end.find('/') + 1);
        if (end.empty() || end[0] == '/') return {};
        fs::path in_other_case;
        for (const auto& file : found_) {
            if (!is_source_or_header(file) && !is_idl(file)) continue;
            const std::string path = file.string();
            if (path.size() <= end.size() || path[path.size() - end.size() - 1] != '/') continue;
            const std::string last = path.substr(path.size() - end.size());
            if (last == end) return file;
            if (in_other_case.empty() && to_lower(last) == to_lower(end)) in_other_case = file;
        }
        return in_other_case;
    }

    // Builds create a header from an IDL file that may be anywhere in the component's folder, in a folder above it, or in
    // an include folder, or the neighbour's. Catkin projects include the header as PROJECT/idl/X.hh.
    void find_idl(const std::string& name) {
        const fs::path header(name);
        const std::string idl = idl_of_header(header);
        if (idl.empty()) return;
        auto found = idl_file(header.parent_path(), idl);
        if (found.empty()) found = neighbour_of(name);
        if (found.empty()) return;
        if (header.has_parent_path()) result.forwards[name] = header.filename().string();
        // The CMake function finds those in the folder and its idl/.
        if (found.parent_path() == folder_ || found.parent_path() == folder_ / "idl") return;
        if (std::find(result.idl_files.begin(), result.idl_files.end(), found) == result.idl_files.end())
            result.idl_files.push_back(found);
    }

    fs::path idl_file(const fs::path& parent, const std::string& idl) const {
        Paths places;
        for (const char* place : {"idl", ".", "../idl", "..", "../../idl"}) places.push_back(folder_ / place);
        places.insert(places.end(), dirs_.begin(), dirs_.end());
        for (const auto& place : places)
            if (is_file(place / idl)) return (place / idl).lexically_normal();
        const auto below = find_below((parent / idl).string());
        return below.empty() ? find_below(idl) : below;
    }

    fs::path folder_;
    Paths dirs_, found_;
    const NeighbourHeaders& neighbours_;
    std::set<fs::path> places_, visited_;
};

// Returns the text of a forwarding header.
std::string forwarding_text(const std::string& meant) {
    // With quotes, a header made from IDL would include the forwarding header if the names are equal.
    if (meant[0] != '/') return "#include <" + meant + ">\n";
    // A header below a copy of the interface that Tandem provides would include this copy. Its text here includes ours.
    if (has_upstream_api(fs::path(meant).parent_path().parent_path())) return read_text(meant);
    return "#include \"" + meant + "\"\n";
}

} // namespace

IncludeScan scan_includes(const fs::path& folder, const Paths& sources, const Paths& include_dirs,
                          const NeighbourHeaders& neighbours) {
    Scanner scanner(folder, sources, include_dirs, neighbours);
    for (const auto& source : sources) scanner.read(source);
    return scanner.result;
}

fs::path write_forwards(const std::map<std::string, std::string>& forwards, const fs::path& folder) {
    auto search_path = folder / "searched" / "from" / "here";
    fs::create_directories(search_path);
    for (const auto& [name, meant] : forwards) {
        const auto file = (search_path / name).lexically_normal(); // here, '\\' is part of a file name
        if (name.empty() || name[0] == '/' || *file.lexically_relative(folder).begin() == "..") continue;
        if (meant.find_first_of("\"\\\n") != std::string::npos) continue; // #include has no escapes
        fs::create_directories(file.parent_path());
        write_file(file, forwarding_text(meant));
    }
    return search_path;
}

} // namespace tandem::command
