// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/service/call_exception.hpp"

#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/adaptor/service/call_failure.hpp"
#include "proxy/link/protocol/service_exception.hpp"
#include "proxy/wire/signature_match.hpp"

#include <fmt/format.h>

namespace tandem::adaptor {
namespace {

using link::CallStatus;
using link::Reply;

/// Returns the type of a message with one member for each value. Looks for unions of the `declared` fields. Throws the
/// exceptions of archives.
wire::Type types_of(const std::vector<opros_params>& values, const wire::Type& declared) {
    wire::Type message;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!values[i].serializable()) throw opros::archive::archive_type_exception();
        wire::Type wanted;
        if (values.size() == declared.children.size()) wanted.children.push_back(declared.children[i]);
        const auto type = type_of(values[i], wanted);
        message.children.push_back(type.children.size() == 1 ? type.children.front() : type);
    }
    return message;
}

/// The fields of an exception that came across a link, decoded on request.
class EncodedFields final : public opros::exception_fields {
  public:
    EncodedFields(wire::Type types, std::vector<std::byte> bytes)
        : types_(std::move(types)), bytes_(std::move(bytes)) {}

    exception_fields* clone() const override { return new EncodedFields(*this); }
    bool read(std::vector<opros_params>& values) const override {
        try {
            if (!has_types_of(values)) return false;
            CdrIarchive archive{wire::CdrReader(bytes_)};
            for (auto& value : values) value.decode(archive);
            return true;
        } catch (const std::exception&) { // the archive's: the bytes came from another process
            return false;
        }
    }

  private:
    bool has_types_of(const std::vector<opros_params>& values) const {
        return is_assignable(types_, types_of(values, types_));
    }

    const wire::Type types_;
    const std::vector<std::byte> bytes_;
};

/// Returns false if the type of a field differs from the exception's declaration.
bool encode_fields(const std::vector<opros_params>& values, const wire::ExceptionType& declared,
                   std::vector<std::byte>& bytes) {
    if (!is_assignable(types_of(values, declared.fields), declared.fields)) return false;
    wire::CdrWriter writer(bytes);
    CdrOarchive archive(writer);
    for (const auto& value : values) value.encode(archive);
    return true;
}

} // namespace

MethodInvokeException make_exception(const std::string& service, const wire::Operation& operation,
                                     const Reply& reply, std::chrono::milliseconds call_timeout) {
    const std::string text = fmt::format("service '{}': {}", service, describe_failure(reply, call_timeout));
    if (reply.status != CallStatus::user_exception)
        return MethodInvokeException(text, link::system_exception_id(reply.status));
    auto exception = link::decode_service_exception(reply.bytes);
    const auto* declared = operation.find_exception(exception.id);
    if (!declared) return MethodInvokeException(text, exception.id);
    return MethodInvokeException::withFields(text, exception.id,
                                             EncodedFields(declared->fields, std::move(exception.fields)));
}

Reply make_reply(const MethodInvokeException& exception, const wire::Operation& operation) {
    const auto* declared = operation.find_exception(exception.getId());
    if (!declared || !exception.fields() || !exception.fields()->values())
        return Reply::failure(CallStatus::exception, exception.what());
    link::ServiceException thrown{exception.getId(), exception.what(), {}};
    try {
        if (encode_fields(*exception.fields()->values(), *declared, thrown.fields))
            return link::make_exception_reply(thrown);
    } catch (const RefusedText& error) {
        return Reply::failure(CallStatus::exception,
                              fmt::format("{} ({}, whose fields cannot cross: {})", exception.what(),
                                          exception.getId(), error.what()));
    } catch (const opros::archive::archive_type_exception&) { // handled like a field of another type
    }
    return Reply::failure(CallStatus::exception,
                          fmt::format("{} ({} with fields of other types than the IDL's '{}')",
                                      exception.what(), exception.getId(), to_signature(declared->fields)));
}

} // namespace tandem::adaptor
