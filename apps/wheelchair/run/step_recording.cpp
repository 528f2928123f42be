// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/step_recording.hpp"

#include "apps/wheelchair/run/run_directory.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

namespace tandem::wheelchair {

std::unique_ptr<StepRecording> open_step_recording(const std::string& file) {
    const auto path = program_folder().parent_path() / TANDEM_WHEELCHAIR_RECORDING;
    if (!std::filesystem::exists(path))
        throw std::runtime_error(fmt::format(
            "--record needs {}, which is not built: cmake --build has the target wheelchair_recording",
            path.string()));
    // It stays loaded: the kernel may call a signal handler of it until the process ends.
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* function = library != nullptr ? dlsym(library, make_step_recording_name) : nullptr;
    if (function == nullptr) throw std::runtime_error(fmt::format("--record: {}", dlerror()));
    return std::unique_ptr<StepRecording>(reinterpret_cast<MakeStepRecording>(function)(file));
}

} // namespace tandem::wheelchair
