// SPDX-License-Identifier: Apache-2.0
#include <SymbolService.h>

#include <atomic>
#include <map>
#include <memory>
#include <sstream>

namespace {

/// Tools look for a port with this name.
constexpr const char* port_name = "opros.symbol";

/// The provided port through which tools access exported variables: it gives their names, and their values encoded as
/// text or binary. The calling thread reads and writes the variables without a lock, so a tool may see a value while
/// the component changes it. The method names are upstream's, including "setSymbolvalue".
class SymbolPort : public ProvidedServicePort {
  public:
    SymbolPort() {
        addMethod("getSymbolList", makeProvidedMethod(&SymbolPort::getSymbolList, this, "getSymbolList"));
        addMethod("getSymbolValue", makeProvidedMethod(&SymbolPort::getSymbolValue, this, "getSymbolValue"));
        addMethod("setSymbolvalue", makeProvidedMethod(&SymbolPort::setSymbolvalue, this, "setSymbolvalue"));
        addMethod("addSymbol", makeProvidedMethod(&SymbolPort::addSymbol, this, "addSymbol"));
        addMethod("setEncodingRule",
                  makeProvidedMethod(&SymbolPort::setEncodingRule, this, "setEncodingRule"));
        addMethod("getEncodingRule",
                  makeProvidedMethod(&SymbolPort::getEncodingRule, this, "getEncodingRule"));
    }

    /// Takes ownership of the object.
    void addSymbol(const std::string& name, SymbolObject* object) { symbols_[name].reset(object); }
    /// Ignores any other number, which an encoded call may carry.
    void setEncodingRule(SymbolEncodingRule rule) {
        if (rule == OPROS_SYMBOL_ENCODING_STR || rule == OPROS_SYMBOL_ENCODING_BIN) rule_ = rule;
    }
    SymbolEncodingRule getEncodingRule() { return rule_; }

    std::vector<std::string> getSymbolList() {
        std::vector<std::string> names;
        for (const auto& [name, object] : symbols_) names.push_back(name);
        return names;
    }

    /// Returns the encoded value, or an empty string if there is no such symbol.
    std::string getSymbolValue(const std::string& name) {
        const auto found = symbols_.find(name);
        if (found == symbols_.end()) return "";
        std::ostringstream bytes;
        if (rule_ == OPROS_SYMBOL_ENCODING_STR) {
            opros::archive::string_oarchive archive(&bytes);
            found->second->getValue(archive);
        } else {
            opros::archive::binary_oarchive archive(&bytes);
            found->second->getValue(archive);
        }
        return bytes.str();
    }

    /// Returns 0, or -1 if there is no such symbol. Throws an archive exception if the value cannot be decoded.
    int setSymbolvalue(const std::string& name, const std::string& value) {
        const auto found = symbols_.find(name);
        if (found == symbols_.end()) return -1;
        std::istringstream bytes(value);
        if (rule_ == OPROS_SYMBOL_ENCODING_STR) {
            opros::archive::string_iarchive archive(&bytes);
            found->second->setValue(archive);
        } else {
            opros::archive::binary_iarchive archive(&bytes);
            found->second->setValue(archive);
        }
        return 0;
    }

  private:
    std::map<std::string, std::unique_ptr<SymbolObject>> symbols_;
    std::atomic<SymbolEncodingRule> rule_{OPROS_SYMBOL_ENCODING_STR};
};

} // namespace

ReturnType symbolservice_exportSymbol(Component* comp, const std::string& name, SymbolObject* p) {
    if (!comp || !p) return OPROS_BAD_INPUT_PARAMETER;
    auto* port = dynamic_cast<SymbolPort*>(comp->getPort(port_name));
    if (!port) comp->addPort(port_name, port = new SymbolPort);
    port->addSymbol(name, p);
    return OPROS_SUCCESS;
}
