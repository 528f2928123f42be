// SPDX-License-Identifier: Apache-2.0
// Places for log lines that libraries bring along: logger.logstream.NAME.* makes the NAME of
// LogstreamFactory.
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <rtm/LogstreamBase.h>

namespace RTC {

void open_log_streams(Manager::Impl& impl) {
    auto& factory = LogstreamFactory::instance();
    for (const auto& name : factory.getIdentifiers()) {
        const auto* settings = impl.config.findNode("logger.logstream." + name);
        if (settings == nullptr) continue;
        LogstreamBase* stream = factory.createObject(name);
        if (stream == nullptr || !stream->init(*settings)) {
            if (stream != nullptr) factory.deleteObject(stream);
            throw ManagerError("logger.logstream." + name + ": its init() has failed");
        }
        impl.log_streams.push_back(stream);
        Logger::processStreams().addStream(stream->getStreamBuffer());
    }
}

void close_log_streams(Manager::Impl& impl) {
    for (LogstreamBase* stream : impl.log_streams) {
        Logger::processStreams().removeStream(stream->getStreamBuffer());
        LogstreamFactory::instance().deleteObject(stream);
    }
    impl.log_streams.clear();
}

} // namespace RTC
