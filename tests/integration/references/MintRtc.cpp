// SPDX-License-Identifier: Apache-2.0
// Makes objects, recognizes its own, and has a vault keep them.
#include "../rtm/register_rtc.hpp"
#include "MintSkel.h"

#include <rtm/CorbaConsumer.h>
#include <rtm/CorbaPort.h>
#include <rtm/DataFlowComponentBase.h>

#include <iostream>
#include <syncstream>

namespace {

class CoinObject : public POA_TestMint::Coin {
  public:
    explicit CoinObject(CORBA::Long number) : number_(number) {}
    CORBA::Long number() override { return number_; }

  private:
    CORBA::Long number_;
};

class MintService : public POA_TestMint::Mint, public virtual PortableServer::RefCountServantBase {
  public:
    TestMint::Coin_ptr strike(CORBA::Long number) override {
        return number == 1 ? first_._this() : second_._this();
    }
    CORBA::Long number_of(TestMint::Coin_ptr it) override {
        if (CORBA::is_nil(it)) return 0;
        for (auto* mine : {&first_, &second_})
            if (TestMint::Coin_var(mine->_this())->_is_equivalent(it)) return it->number();
        return -1;
    }
    void exchange(TestMint::Coin_ptr& it, TestMint::Coin_out former) override {
        former = TestMint::Coin::_duplicate(it);
        const bool was_first = number_of(it) == 1;
        CORBA::release(it);
        it = strike(was_first ? 2 : 1);
    }

  private:
    CoinObject first_{1}, second_{2};
};

} // namespace

class MintRtc : public RTC::DataFlowComponentBase {
  public:
    explicit MintRtc(RTC::Manager* manager)
        : RTC::DataFlowComponentBase(manager), mintPort_("mint"), vaultPort_("vault") {}

    RTC::ReturnCode_t onInitialize() override {
        mintPort_.registerProvider("mint", "TestMint::Mint", mint_);
        addPort(mintPort_);
        vaultPort_.registerConsumer("vault", "TestMint::Vault", vault_);
        addPort(vaultPort_);
        return RTC::RTC_OK;
    }
    RTC::ReturnCode_t onExecute(RTC::UniqueId) override {
        if (done_) return RTC::RTC_OK;
        try {
            use_vault();
        } catch (const CORBA::TRANSIENT&) { // the vault is not there yet
        }
        return RTC::RTC_OK;
    }

  private:
    void use_vault() {
        const TestMint::Coin_var first = mint_.strike(1), second = mint_.strike(2);
        vault_->keep("one", first);
        const TestMint::Coin_var kept = vault_->kept("one"), none = vault_->kept("nothing");
        TestMint::Coin_var swapped = TestMint::Coin::_duplicate(second), given;
        vault_->swap("one", swapped.inout(), given.out());
        const TestMint::Coin_var kept_then = vault_->kept("one");
        std::osyncstream(std::cout) << "mint: kept " << mint_.number_of(kept) << ", none "
                                    << CORBA::is_nil(none) << ", swapped " << mint_.number_of(swapped)
                                    << ", given " << mint_.number_of(given) << ", kept then "
                                    << mint_.number_of(kept_then) << std::endl;
        done_ = true;
    }

    bool done_ = false;
    MintService mint_;
    RTC::CorbaPort mintPort_, vaultPort_;
    RTC::CorbaConsumer<TestMint::Vault> vault_;
};

extern "C" void MintRtcInit(RTC::Manager* manager) { register_rtc<MintRtc>(manager, "MintRtc"); }
