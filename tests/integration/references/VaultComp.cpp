// SPDX-License-Identifier: Apache-2.0
// Keeps objects of a mint as texts, and gives them back to it.
#include "simple_component.h"

#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include <iostream>
#include <map>
#include <mutex>
#include <string>
#include <syncstream>

class IVault {
  public:
    virtual ~IVault() {}
    virtual void keep(std::string name, std::string it) = 0;
    virtual std::string kept(std::string name) = 0;
    virtual void swap(std::string name, std::string& it, std::string& given) = 0;
};

class VaultProvided : public ProvidedServicePort {
  public:
    explicit VaultProvided(IVault* vault) {
        addMethod("keep", makeProvidedMethod(&IVault::keep, vault, "keep"));
        addMethod("kept", makeProvidedMethod(&IVault::kept, vault, "kept"));
        addMethod("swap", makeProvidedMethod(&IVault::swap, vault, "swap"));
    }
};

class MintRequired : public RequiredServicePort {
  public:
    MintRequired() {
        strike_ = reinterpret_cast<RequiredMethod<std::string>*>(
            add(makeRequiredMethod(&MintRequired::strike, "strike")));
        number_of_ = reinterpret_cast<RequiredMethod<int>*>(
            add(makeRequiredMethod(&MintRequired::number_of, "number_of")));
        exchange_ = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&MintRequired::exchange, "exchange")));
    }
    std::string strike(int number) { return (*strike_)(number); }
    int number_of(std::string it) { return (*number_of_)(it); }
    void exchange(std::string& it, std::string& former) { (*exchange_)(it, former); }

  private:
    Method* add(Method* method) {
        addMethod(method->getName(), method);
        return method;
    }
    RequiredMethod<std::string>* strike_;
    RequiredMethod<int>* number_of_;
    RequiredMethod<void>* exchange_;
};

class VaultComp : public SimpleComponent, public IVault {
  public:
    VaultComp() {
        addPort("mint", mint_);
        addPort("vault", new VaultProvided(this)); // the component deletes its service ports
    }
    void keep(std::string name, std::string it) override {
        const std::lock_guard lock(mutex_);
        kept_[name] = it;
    }
    std::string kept(std::string name) override {
        const std::lock_guard lock(mutex_);
        const auto found = kept_.find(name);
        return found == kept_.end() ? "" : found->second;
    }
    void swap(std::string name, std::string& it, std::string& given) override {
        const std::lock_guard lock(mutex_);
        given = it;
        std::swap(kept_[name], it);
    }
    ReturnType onExecute() override {
        if (done_) return OPROS_SUCCESS;
        try {
            use_mint();
        } catch (MethodInvokeException& error) {
            if (error.getId().find("TRANSIENT") == std::string::npos)
                say(error.getId() + ": " + error.getMessage());
        }
        return OPROS_SUCCESS;
    }

  private:
    void use_mint() {
        const std::string first = mint_->strike(1), second = mint_->strike(2);
        std::string it = first, former;
        mint_->exchange(it, former);
        say("coins " + number(first) + " and " + number(second) + ", exchanged " + number(it) + ", former " +
            number(former) + ", none " + number("") + ", other text " + number("a coin"));
        done_ = true;
    }
    std::string number(const std::string& it) {
        try {
            return std::to_string(mint_->number_of(it));
        } catch (MethodInvokeException& error) {
            return error.getId();
        }
    }
    static void say(const std::string& what) {
        std::osyncstream(std::cout) << "vault: " << what << std::endl;
    }

    bool done_ = false;
    std::mutex mutex_; ///< calls come in threads of the link
    std::map<std::string, std::string> kept_;
    MintRequired* mint_ = new MintRequired;
};

extern "C" {
Component* getComponent() { return new VaultComp; }
void releaseComponent(Component* component) { delete component; }
}
