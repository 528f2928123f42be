// SPDX-License-Identifier: Apache-2.0
#include <Component.h>
#include <InputDataPort.h>

#include <catch2/catch.hpp>
#include <thread>

namespace {
class Subject : public Component {
  public:
    std::string calls;
    ReturnType answer = OPROS_SUCCESS;
    InputDataPort<int> in;
    Subject() { addPort("in", &in); }

  protected:
    ReturnType note(char c) {
        calls += c;
        return answer;
    }
    ReturnType onInitialize() override { return note('i'); }
    ReturnType onStart() override { return note('s'); }
    ReturnType onStop() override { return note('p'); }
    ReturnType onReset() override { return note('r'); }
    ReturnType onError() override { return note('e'); }
    ReturnType onRecover() override { return note('c'); }
    ReturnType onDestroy() override { return note('d'); }
};
} // namespace

TEST_CASE("a component lives from CREATED to DESTROYED") {
    Subject subject;
    CHECK(subject.getStatus() == OPROS_CS_CREATED);
    CHECK(subject.initialize() == OPROS_SUCCESS);
    CHECK(subject.getStatus() == OPROS_CS_READY);
    CHECK(subject.start() == OPROS_SUCCESS);
    CHECK(subject.getStatus() == OPROS_CS_ACTIVE);
    CHECK(subject.stop() == OPROS_SUCCESS);
    CHECK(subject.getStatus() == OPROS_CS_INACTIVE);
    CHECK(subject.start() == OPROS_SUCCESS);
    CHECK(subject.destroy() == OPROS_SUCCESS);
    CHECK(subject.getStatus() == OPROS_CS_DESTROYED);
    CHECK(subject.calls == "ispsd");
}

TEST_CASE("a transition to the present state succeeds without a callback") {
    Subject subject;
    subject.initialize();
    CHECK(subject.initialize() == OPROS_SUCCESS);
    subject.start();
    CHECK(subject.start() == OPROS_SUCCESS);
    CHECK(subject.calls == "is");
}

TEST_CASE("a transition that the state does not allow is refused without a callback") {
    Subject subject;
    CHECK(subject.start() == OPROS_PRECONDITION_NOT_MET);
    CHECK(subject.stop() == OPROS_PRECONDITION_NOT_MET);
    CHECK(subject.destroy() == OPROS_PRECONDITION_NOT_MET);
    CHECK(subject.recover() == OPROS_PRECONDITION_NOT_MET);
    CHECK(subject.stopOnError() == OPROS_PRECONDITION_NOT_MET);
    CHECK(subject.calls.empty());
}

TEST_CASE("a callback that fails leaves the state unchanged and its code is in getErrorInfo") {
    Subject subject;
    subject.answer = OPROS_FIND_DLL_ERROR;
    CHECK(subject.initialize() == OPROS_PRECONDITION_NOT_MET);
    CHECK(subject.getStatus() == OPROS_CS_CREATED);
    CHECK(subject.getErrorInfo() == OPROS_FIND_DLL_ERROR);
}

TEST_CASE("recover leads out of ERROR, and reset starts again from any state") {
    Subject subject;
    subject.initialize();
    subject.start();
    CHECK(subject.stopOnError() == OPROS_SUCCESS);
    CHECK(subject.getStatus() == OPROS_CS_ERROR);
    CHECK(subject.recover() == OPROS_SUCCESS);
    CHECK(subject.getStatus() == OPROS_CS_READY);
    CHECK(subject.reset() == OPROS_SUCCESS);
    CHECK(subject.getStatus() == OPROS_CS_ACTIVE);
    CHECK(subject.calls == "isecris");
}

TEST_CASE("a component is in ERROR even if its onError fails") {
    Subject subject;
    subject.initialize();
    subject.start();
    subject.answer = OPROS_UNSUPPORTED_METHOD;
    CHECK(subject.stopOnError() == OPROS_PRECONDITION_NOT_MET);
    CHECK(subject.getStatus() == OPROS_CS_ERROR);
}

TEST_CASE("a stop empties the input queues") {
    Subject subject;
    subject.initialize();
    subject.start();
    int value = 1;
    subject.in.push(value);
    subject.stop();
    CHECK(subject.in.getSize() == 0);
}

TEST_CASE("a thread that onStop waits for may report an error meanwhile") {
    class Waiting : public Subject {
        ReturnType onStop() override {
            std::thread([this] { stopOnError(); }).join();
            return OPROS_SUCCESS;
        }
    } subject;
    subject.initialize();
    subject.start();
    CHECK(subject.stop() == OPROS_PRECONDITION_NOT_MET);
    CHECK(subject.getStatus() == OPROS_CS_ERROR);
}

TEST_CASE("a component that overrides nothing does not initialize") {
    Component bare;
    CHECK(bare.initialize() == OPROS_PRECONDITION_NOT_MET);
    CHECK(bare.getErrorInfo() == OPROS_UNSUPPORTED_METHOD);
}

TEST_CASE("fail leads to ERROR from any state, and calls onError unless the state was CREATED") {
    Subject created;
    CHECK(created.fail() == OPROS_SUCCESS);
    CHECK(created.getStatus() == OPROS_CS_ERROR);
    CHECK(created.calls == "");
    Subject ready;
    ready.initialize();
    CHECK(ready.fail() == OPROS_SUCCESS);
    CHECK(ready.getStatus() == OPROS_CS_ERROR);
    CHECK(ready.calls == "ie");
    CHECK(ready.fail() == OPROS_SUCCESS);
    CHECK(ready.calls == "ie");
}
