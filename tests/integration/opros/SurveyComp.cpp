// SPDX-License-Identifier: Apache-2.0
// Sends values of user-defined classes, and prints the answers.
#include "SurveyorRequired.h"

#include "simple_component.h"

#include <OPRoSInclude.h>

#include <iostream>
#include <memory>
#include <syncstream>

class SurveyComp : public SimpleComponent {
  public:
    SurveyComp() {
        addPort("mark", &mark_);
        addPort("markBack", &markBack_);
        addPort("scan", &scan_);
        addPort("scanBack", &scanBack_);
        addPort("reading", &reading_);
        addPort("readingBack", &readingBack_);
        addPort("surveyor", surveyor_);
    }

    ReturnType onExecute() override {
        while (const std::unique_ptr<opros_any> any{markBack_.pop()})
            std::osyncstream(std::cout) << "mark: " << text(markBack_.getContent(*any)) << std::endl;
        while (const std::unique_ptr<opros_any> any{scanBack_.pop()}) print(scanBack_.getContent(*any));
        while (const std::unique_ptr<opros_any> any{readingBack_.pop()}) print(readingBack_.getContent(*any));
        Scan scan;
        scan.id = 7;
        scan.valid = true;
        scan.marks = {mark(1, 2, "door"), mark(-0.25, 4, "lift")};
        mark_.push(scan.marks[0]);
        scan_.push(scan);
        Reading reading;
        reading.channel = 3;
        reading.values = {1, 2.5};
        reading_.push(reading);
        try {
            const std::vector<Mark> moved = surveyor_->move(scan.marks, 10);
            std::osyncstream line(std::cout);
            line << "moved:";
            for (const Mark& each : moved) line << " " << text(each);
            line << std::endl;
        } catch (const MethodInvokeException& error) {
            std::osyncstream(std::cout) << "refused: " << error.what() << std::endl;
        }
        return OPROS_SUCCESS;
    }

  private:
    static Mark mark(double x, double y, const std::string& label) {
        Mark mark;
        mark.x = x;
        mark.y = y;
        mark.label = label;
        return mark;
    }
    static std::string text(const Mark& mark) {
        return mark.label + " " + std::to_string(mark.x).substr(0, 5) + " " +
               std::to_string(mark.y).substr(0, 5);
    }
    static void print(const Scan& scan) {
        std::osyncstream line(std::cout);
        line << "scan: " << scan.id << (scan.valid ? " valid" : " not valid");
        for (const Mark& each : scan.marks) line << ", " << text(each);
        line << std::endl;
    }
    static void print(const Reading& reading) {
        std::osyncstream line(std::cout);
        line << "reading: " << reading.channel;
        for (const double value : reading.values) line << " " << value;
        line << std::endl;
    }

    OutputDataPort<Mark> mark_;
    InputDataPort<Mark> markBack_;
    OutputDataPort<Scan> scan_;
    InputDataPort<Scan> scanBack_;
    OutputDataPort<Reading> reading_;
    InputDataPort<Reading> readingBack_;
    SurveyorRequired* surveyor_ = new SurveyorRequired; // the component deletes its service ports
};

extern "C" {
Component* getComponent() { return new SurveyComp; }
void releaseComponent(Component* component) { delete component; }
}
