// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/sdo/tool_services.hpp"
#include "host/process/start_thread.hpp"
#include "host/rtm/runtime/sdo/component_observer.hpp"
#include "host/rtm/runtime/sdo/log_publisher.hpp"
#include <atomic>
#include <rtm/NVUtil.h>

namespace RTC {
namespace {

// Each link has a thread.
constexpr int max_links_of_process = 512;
std::atomic<int> links{0};

} // namespace

bool ToolService::init(RTObject_impl& component, const SDOPackage::ServiceProfile& profile) {
    if (CORBA::is_nil(profile.service.in())) return false;
    component_ = &component;
    profile_ = profile;
    const coil::Properties settings = NVUtil::toProperties(profile.properties);
    const std::string name = "the tool that observes " + std::string(component.getInstanceName());
    const auto refuse = [&](const char* why) {
        Logger rtclog("tools");
        RTC_ERROR(("%s gets nothing: %s", name.c_str(), why));
        return false;
    };
    if (++links > max_links_of_process) {
        --links;
        return refuse("this process already has 512 observers");
    }
    link_ = std::make_unique<ToolLink>(profile_.service.in(), name, periodic(settings));
    try {
        link_->start();
    } catch (const tandem::process::NotStarted& e) {
        link_.reset();
        --links;
        return refuse(e.what());
    }
    start(settings);
    return true;
}

void ToolService::begin_finalize() {
    if (link_ != nullptr) link_->request_end();
}

bool ToolService::reinit(const SDOPackage::ServiceProfile& profile) {
    finalize();
    return init(*component_, profile);
}

void ToolService::finalize() {
    if (link_ == nullptr) return;
    stop();
    link_->finish(); // its tasks use link_
    link_.reset();
    --links;
}

std::unique_ptr<ToolService> make_tool_service(const std::string& type) {
    if (type == "IDL:OpenRTM/ComponentObserver:1.0") return std::make_unique<ComponentObserver>(false);
    if (type == "IDL:omg.org/RTC/ComponentObserver:1.0") return std::make_unique<ComponentObserver>(true);
    if (type == "IDL:OpenRTM/Logger:1.0") return std::make_unique<LogPublisher>();
    return nullptr;
}

} // namespace RTC
