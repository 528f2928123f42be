// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/sdo/tool_link.hpp"
#include <memory>
#include <rtm/SdoServiceConsumerBase.h>

namespace RTC {

/// A consumer of a tool's service that this runtime contains. OpenRTM-aist has them in modules. init() and finalize() follow
/// each other; the owner serializes them.
class ToolService : public SdoServiceConsumerBase {
  public:
    bool init(RTObject_impl& component, const SDOPackage::ServiceProfile& profile) override;
    bool reinit(const SDOPackage::ServiceProfile& profile) override;
    const SDOPackage::ServiceProfile& getProfile() const override { return profile_; }
    /// Lets the link end, without waiting. finalize() follows.
    void begin_finalize();
    void finalize() override;
    /// Returns whether the tool has ended without removing its service.
    bool is_lost() const { return link_ == nullptr || link_->is_lost(); }

  protected:
    /// Begins to send what the tool wants to know, according to the profile's properties.
    virtual void start(const coil::Properties& settings) = 0;
    /// Returns when nothing calls send() any more.
    virtual void stop() = 0;
    virtual std::vector<ToolLink::Periodic> periodic(const coil::Properties&) { return {}; }

    RTObject_impl& component() const { return *component_; }
    void send(const char* operation, ToolLink::Arguments arguments) const {
        link_->send(operation, std::move(arguments));
    }

  private:
    RTObject_impl* component_ = nullptr;
    SDOPackage::ServiceProfile profile_;
    std::unique_ptr<ToolLink> link_;
};

/// Returns a consumer of the service with this repository id, or null if this runtime contains none: observers of
/// components, loggers.
std::unique_ptr<ToolService> make_tool_service(const std::string& type);

} // namespace RTC
