// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/step_recording.hpp"

#include "apps/wheelchair/run/run_directory.hpp"
#include "host/plugin/library.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tandem::wheelchair {

std::unique_ptr<StepRecording> open_step_recording(const std::string& file) {
    const auto path = program_folder().parent_path() / TANDEM_WHEELCHAIR_RECORDING;
    if (!std::filesystem::exists(path))
        throw std::runtime_error(fmt::format(
            "--record needs {}, which is not built; build the target wheelchair_recording", path.string()));
    // Never unloaded, because the kernel may call its signal handler until the process ends.
    static auto* const library = new std::shared_ptr(plugin::Library::load(path));
    return std::unique_ptr<StepRecording>(
        (*library)->symbol<MakeStepRecording>(make_step_recording_name)(file));
}

} // namespace tandem::wheelchair
