// SPDX-License-Identifier: Apache-2.0
// Provides a service, and writes the data and events that it receives into the file that its property names.
#include "tests/host/opros/fixtures/MathProvided.h"

#include <Component.h>
#include <EventData.h>
#include <InputDataPort.h>
#include <InputEventPort.h>
#include <ServiceUtils.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

class NodeSink : public Component, public IMath {
    InputDataPort<std::vector<double>> numbers{OPROS_FIFO, 16};
    InputDataPort<Pose> poses{OPROS_FIFO, 16};
    InputEventPort<std::string> news;

    void write(const std::string& line) {
        std::ofstream(getProperty("file"), std::ios::app) << line << std::endl;
    }

  public:
    NodeSink() {
        addPort("numbers", &numbers);
        addPort("poses", &poses);
        addPort("news", &news);
        addPort("sums", new MathProvided(this));
        news.setOwner(this);
    }

    double add(double a, double b) override { return a + b; }
    Pose turn(Pose pose, int times) override {
        for (int i = 0; i < times; ++i) pose.frame = "turned " + pose.frame;
        return pose;
    }
    void note(std::string) override {}

    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }
    ReturnType onError() override { return OPROS_SUCCESS; }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onEvent(Event* event) override {
        auto* data = static_cast<EventData<std::string>*>(event);
        write("event " + data->getId() + " " + *data->getContentData());
        return OPROS_SUCCESS;
    }
    ReturnType onExecute() override {
        while (auto value = std::unique_ptr<opros_any>(numbers.pop()))
            write("number " + std::to_string(static_cast<int>(numbers.getContent(*value).at(0))));
        while (auto value = std::unique_ptr<opros_any>(poses.pop()))
            write("pose " + poses.getContent(*value).frame);
        return OPROS_SUCCESS;
    }
};

extern "C" {
Component* getComponent() { return new NodeSink; }
void releaseComponent(Component* component) { delete component; }
}
