// SPDX-License-Identifier: Apache-2.0
// Each cycle sends its number as data and as an event, and calls a service of another component, also in onStart. Writes the
// answers into the file that its property names.
#include "tests/host/opros/fixtures/MathRequired.h"

#include <Component.h>
#include <EventData.h>
#include <OutputDataPort.h>
#include <OutputEventPort.h>
#include <ServiceUtils.h>

#include <fstream>
#include <string>
#include <vector>

class NodeSource : public Component {
    OutputDataPort<std::vector<double>> numbers;
    OutputDataPort<Pose> poses;
    OutputEventPort<std::string> news;
    MathRequired* math = new MathRequired;
    int cycle = 0;

  public:
    NodeSource() {
        addPort("numbers", &numbers);
        addPort("poses", &poses);
        addPort("news", &news);
        addPort("math", math);
    }

    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }
    ReturnType onError() override { return OPROS_SUCCESS; }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return math->add(1, 2) == 3 ? OPROS_SUCCESS : OPROS_CALLER_ERROR; }
    ReturnType onExecute() override {
        numbers.push(std::vector<double>(1, ++cycle));
        Pose pose;
        pose.frame = "frame " + std::to_string(cycle);
        poses.push(pose);
        EventData<std::string> event;
        event.setId("tick");
        event.setContentData(std::to_string(cycle));
        news.push(&event);
        const double sum = math->add(cycle, 0.5);
        const std::string frame = math->turn(pose, 1).frame;
        std::ofstream(getProperty("file"), std::ios::app)
            << "answer " << cycle << ' ' << sum << ' ' << frame << std::endl;
        return OPROS_SUCCESS;
    }
};

extern "C" {
Component* getComponent() { return new NodeSource; }
void releaseComponent(Component* component) { delete component; }
}
