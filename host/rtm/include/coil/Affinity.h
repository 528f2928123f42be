// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_AFFINITY_H
#define COIL_AFFINITY_H
#include <string>
#include <vector>

namespace coil {

/// The numbers of the processors on which a thread may run. All functions return false on failure. Setting fails for
/// processors that do not exist.
using CpuMask = std::vector<unsigned int>;

bool getProcCpuAffinity(CpuMask& cpu_mask);
bool setProcCpuAffinity(const CpuMask& cpu_mask);
/// Parses a text such as `0,2`. Returns false if it is invalid or the kernel refuses the mask.
bool setProcCpuAffinity(const std::string& cpu_mask);
bool getThreadCpuAffinity(CpuMask& cpu_mask);
bool setThreadCpuAffinity(const CpuMask& cpu_mask);
bool setThreadCpuAffinity(const std::string& cpu_mask);

} // namespace coil
#endif
