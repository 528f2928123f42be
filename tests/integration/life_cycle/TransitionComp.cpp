// SPDX-License-Identifier: Apache-2.0
// Makes the transitions of components of its application that a file lists (`1 stop Motor`), and prints the results. The
// property `commands` names the file, to which the test appends.
#include <ComponentDirectory.h>
#include <OPRoSInclude.h>

#include <fstream>
#include <iostream>
#include <sstream>
#include <syncstream>

namespace {

const char* name_of(LifecycleState state) {
    static const char* const names[] = {"CREATED", "READY", "ACTIVE", "INACTIVE", "ERROR", "DESTROYED"};
    return names[state];
}

} // namespace

class TransitionComp : public Component, public ComponentDirectoryUser {
  public:
    void setComponentDirectory(ComponentDirectory* directory) override { directory_ = directory; }

    ReturnType onExecute() override {
        std::ifstream file(getProperty("commands"));
        std::string line;
        for (int number = 0; std::getline(file, line) && !file.eof(); ++number)
            if (number == done_) {
                ++done_;
                carry_out(line);
            }
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override { return OPROS_SUCCESS; }
    ReturnType onStop() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    void carry_out(const std::string& line) {
        std::istringstream words(line);
        std::string number, verb, name;
        words >> number >> verb >> name;
        const std::string error = execute(verb, name);
        std::osyncstream(std::cout) << "transition " << number << ": " << name << " is "
                                    << name_of(directory_->find(name)->getStatus())
                                    << (error.empty() ? "" : ", " + error) << std::endl;
    }
    std::string execute(const std::string& verb, const std::string& name) {
        if (verb == "start") return directory_->transition(name, TRANSITION_START);
        if (verb == "stop") return directory_->transition(name, TRANSITION_STOP);
        if (verb == "recover") return directory_->transition(name, TRANSITION_RECOVER);
        if (verb == "destroy") return directory_->transition(name, TRANSITION_DESTROY);
        if (verb == "reset") return directory_->find(name)->reset() == OPROS_SUCCESS ? "" : "reset failed";
        if (verb == "fail")
            return directory_->find(name)->stopOnError() == OPROS_SUCCESS ? "" : "it was not ACTIVE";
        return ""; // state
    }

    ComponentDirectory* directory_ = nullptr;
    int done_ = 0;
};

extern "C" {
Component* getComponent() { return new TransitionComp; }
void releaseComponent(Component* component) { delete component; }
}
