// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_UUID_H
#define COIL_UUID_H
#include <memory>
#include <string>

namespace coil {

class UUID {
  public:
    explicit UUID(std::string text = std::string()) : text_(std::move(text)) {}
    const char* to_string() const { return text_.c_str(); }

  private:
    std::string text_;
};

class UUID_Generator {
  public:
    void init() {}
    /// Returns a random UUID (RFC 4122, version 4). OpenRTM-aist's arguments have no effect here.
    std::unique_ptr<UUID> generateUUID(int number = 1, int flags = 1);
};

} // namespace coil
#endif
