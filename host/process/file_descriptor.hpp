// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shm/os/file_descriptor.hpp"

namespace tandem::process {

/// The owning file descriptor of shm/os, for all code outside shm.
using shm::FileDescriptor;

} // namespace tandem::process
