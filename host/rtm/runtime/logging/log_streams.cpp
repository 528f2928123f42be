// SPDX-License-Identifier: Apache-2.0
// Log streams that modules bring along, as OpenRTM-aist's Manager::initLogstreamPlugins() makes them: the
// settings logger.logstream.NAME.* create the stream that LogstreamFactory knows as NAME.
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <rtm/LogstreamBase.h>

namespace RTC {

void open_log_streams(Manager::Impl& impl) {
    auto& factory = LogstreamFactory::instance();
    for (const auto& name : factory.getIdentifiers()) {
        const auto* settings = impl.config.findNode("logger.logstream." + name);
        if (settings == nullptr) continue; // registered by a module, but not configured
        LogstreamBase* stream = factory.createObject(name);
        if (stream == nullptr || !stream->init(*settings)) {
            if (stream != nullptr) factory.deleteObject(stream);
            throw ManagerError("logger.logstream." + name +
                               ": init() of the log stream has failed; check its settings");
        }
        impl.log_streams.push_back(stream);
        Logger::processStreams().addStream(stream->getStreamBuffer());
    }
}

// Lines that are logged after this only go to the files.
void close_log_streams(Manager::Impl& impl) {
    for (LogstreamBase* stream : impl.log_streams) {
        Logger::processStreams().removeStream(stream->getStreamBuffer());
        LogstreamFactory::instance().deleteObject(stream);
    }
    impl.log_streams.clear();
}

} // namespace RTC
