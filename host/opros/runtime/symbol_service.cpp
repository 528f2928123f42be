// SPDX-License-Identifier: Apache-2.0
#include <SymbolService.h>

#include <map>
#include <memory>
#include <sstream>

namespace {

constexpr const char* port_name = "opros.symbol";

/// The provided port that shows exported variables: by name, their values encoded.
class SymbolPort : public ProvidedServicePort {
  public:
    SymbolPort() {
        addMethod("getSymbolList", makeProvidedMethod(&SymbolPort::getSymbolList, this, "getSymbolList"));
        addMethod("getSymbolValue", makeProvidedMethod(&SymbolPort::getSymbolValue, this, "getSymbolValue"));
        addMethod("setSymbolvalue", makeProvidedMethod(&SymbolPort::setSymbolvalue, this, "setSymbolvalue"));
    }

    void add(const std::string& name, SymbolObject* object) { symbols_[name].reset(object); }

    std::vector<std::string> getSymbolList() {
        std::vector<std::string> names;
        for (const auto& [name, object] : symbols_) names.push_back(name);
        return names;
    }

    std::string getSymbolValue(std::string name) {
        const auto found = symbols_.find(name);
        if (found == symbols_.end()) return "";
        std::ostringstream bytes;
        opros::archive::binary_oarchive archive(&bytes);
        found->second->getValue(archive);
        return bytes.str();
    }

    bool setSymbolvalue(std::string name, std::string value) {
        const auto found = symbols_.find(name);
        if (found == symbols_.end()) return false;
        std::istringstream bytes(value);
        opros::archive::binary_iarchive archive(&bytes);
        found->second->setValue(archive);
        return true;
    }

  private:
    std::map<std::string, std::unique_ptr<SymbolObject>> symbols_;
};

} // namespace

ReturnType symbolservice_exportSymbol(Component* comp, const std::string& name, SymbolObject* p) {
    if (!comp || !p) return OPROS_BAD_INPUT_PARAMETER;
    auto* port = dynamic_cast<SymbolPort*>(comp->getPort(port_name));
    if (!port) comp->addPort(port_name, port = new SymbolPort);
    port->add(name, p);
    return OPROS_SUCCESS;
}
