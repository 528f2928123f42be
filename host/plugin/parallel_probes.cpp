// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/parallel_probes.hpp"

#include <algorithm>
#include <thread>

namespace tandem::plugin {

ParallelProbes::ParallelProbes(ProbeOptions options, std::string task)
    : options_(std::move(options)), task_(std::move(task)),
      free_processors_(std::max(1U, std::thread::hardware_concurrency())) {}

std::future<std::string> ParallelProbes::start(const Subject& subject) {
    return std::async(std::launch::async, [this, subject] {
        free_processors_.acquire(); // each probe ends within its timeout
        struct Release {
            std::counting_semaphore<>& processors;
            ~Release() { processors.release(); }
        } const release{free_processors_};
        return run_probe(options_, task_, subject.first, subject.second);
    });
}

void ParallelProbes::begin(const std::filesystem::path& library, const std::vector<std::string>& arguments) {
    Subject subject{library, arguments};
    const std::lock_guard lock(mutex_);
    if (!begun_.contains(subject)) begun_.emplace(subject, start(subject));
}

std::string ParallelProbes::finish(const std::filesystem::path& library,
                                   const std::vector<std::string>& arguments) {
    std::future<std::string> result;
    {
        const std::lock_guard lock(mutex_);
        auto begun = begun_.extract({library, arguments});
        if (!begun.empty()) result = std::move(begun.mapped());
    }
    return result.valid() ? result.get() : run_probe(options_, task_, library, arguments);
}

} // namespace tandem::plugin
