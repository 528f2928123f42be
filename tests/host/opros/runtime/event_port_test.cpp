// SPDX-License-Identifier: Apache-2.0
#include "tests/host/opros/runtime/recording_archive.hpp"

#include <EventCallBack.h>
#include <InputEventPort.h>
#include <OutputEventPort.h>

#include <catch2/catch.hpp>
#include <memory>

namespace {
class Listener : public Component {
  public:
    std::vector<std::string> heard;
    ReturnType onEvent(Event* event) override {
        heard.push_back("component " + event->getId());
        return OPROS_SUCCESS;
    }
    void any_event(Event* event) { heard.push_back("any " + event->getId()); }
    void typed(EventData<std::string>* event) { heard.push_back("typed " + *event->getContentData()); }
    void with_id(const std::string& id, const std::string& text) { heard.push_back(id + " " + text); }
    void text_only(const std::string& text) { heard.push_back("text " + text); }
};
std::string heard_by_function;
void free_function(const std::string& text) { heard_by_function = text; }

EventData<std::string> event(const std::string& text) {
    EventData<std::string> made;
    made.setId("greeting");
    made.setContentData(text);
    return made;
}
} // namespace

TEST_CASE("an event goes to the component that owns the port") {
    Listener listener;
    InputEventPort<std::string> port;
    auto hello = event("hello");
    CHECK(port.push(&hello) == OPROS_CALLER_ERROR);
    port.setOwner(&listener);
    CHECK(port.push(&hello) == OPROS_SUCCESS);
    CHECK(listener.heard == std::vector<std::string>{"component greeting"});
}

TEST_CASE("a callback in any of its four forms gets the event instead of the component") {
    Listener listener;
    InputEventPort<std::string> port;
    port.setOwner(&listener);
    auto hello = event("hello");
    SET_EVENT_CALLBACK(port, Listener::any_event, &listener);
    port.push(&hello);
    SET_EVENT_CALLBACK(port, Listener::typed, &listener);
    port.push(&hello);
    SET_EVENT_CALLBACK(port, Listener::with_id, &listener);
    port.push(&hello);
    SET_EVENT_CALLBACK(port, Listener::text_only, &listener);
    port.push(&hello);
    SET_EVENT_CALLBACK_EX(port, free_function);
    port.push(&hello);
    CHECK(listener.heard ==
          std::vector<std::string>{"any greeting", "typed hello", "greeting hello", "text hello"});
    CHECK(heard_by_function == "hello");
}

TEST_CASE("EventCallBackMethod makes a callback from a member function or from a function") {
    Listener listener;
    InputEventPort<std::string> port;
    auto hello = event("hi");
    port.setOwner(new EventCallBackMethod<std::string, Listener>(&Listener::with_id, &listener));
    port.push(&hello);
    CHECK(listener.heard == std::vector<std::string>{"greeting hi"});
    port.setOwner(new EventCallBackMethod<std::string, void>(free_function));
    port.push(&hello);
    CHECK(heard_by_function == "hi");
}

TEST_CASE("an event of another content type is refused") {
    Listener listener;
    InputEventPort<std::string> port;
    port.setOwner(&listener);
    EventData<int> number;
    number.setContentData(3);
    CHECK(port.push(&number) == OPROS_BAD_INPUT_PARAMETER);
    OutputEventPort<std::string> same;
    OutputEventPort<int> other;
    CHECK(same.checkType(&port));
    CHECK_FALSE(other.checkType(&port));
    CHECK(port.sample().type() == "std::string");
}

TEST_CASE("a cloned event has the id, names and content of the original, or no content") {
    EventData<std::string> first = event("text");
    first.setTopic("topic");
    std::unique_ptr<Event> copy(first.clone());
    CHECK(copy->getTopic() == "topic");
    CHECK(*static_cast<EventData<std::string>*>(copy.get())->getContentData() == "text");
    CHECK(EventData<std::string>().getContentData() == nullptr);
    CHECK(EventData<std::string>().getId() == "event");
}

TEST_CASE("an event crosses an archive with its id and content") {
    Listener listener;
    InputEventPort<std::string> port;
    SET_EVENT_CALLBACK(port, Listener::with_id, &listener);
    BinaryPipe pipe;
    pipe.out << event("far");
    CHECK(port.push(pipe.in) == OPROS_SUCCESS);
    CHECK(listener.heard == std::vector<std::string>{"greeting far"});
}
