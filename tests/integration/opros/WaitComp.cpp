// SPDX-License-Identifier: Apache-2.0
// Waits for replies, which it prints. A separate thread waits for words that come through a named pipe, and asks the
// dictionary about them.
#include <OPRoSInclude.h>
#include <ServiceUtils.h>

#include "DictionaryRequired.h"

#include <fcntl.h>
#include <iostream>
#include <memory>
#include <syncstream>
#include <thread>
#include <unistd.h>

class WaitComp : public Component {
  public:
    WaitComp() {
        addPort("reply", &reply_);
        addPort("dictionary", dictionary_);
    }

    ReturnType onExecute() override {
        while (const std::unique_ptr<opros_any> reply{reply_.pop()})
            print("reply: " + reply_.getContent(*reply));
        return OPROS_SUCCESS;
    }

  protected:
    ReturnType onInitialize() override { return OPROS_SUCCESS; }
    ReturnType onStart() override {
        // For reading and writing: such a pipe never ends, and onStop() can wake the thread by it.
        pipe_ = open(getProperty("pipe").c_str(), O_RDWR | O_CLOEXEC);
        if (pipe_ < 0) return OPROS_CALL_API_ERROR;
        reader_ = std::thread([this] { read_words(); });
        return OPROS_SUCCESS;
    }
    ReturnType onStop() override {
        if (write(pipe_, "\n", 1) != 1) return OPROS_CALL_API_ERROR;
        reader_.join();
        close(pipe_);
        return OPROS_SUCCESS;
    }
    ReturnType onReset() override { return OPROS_SUCCESS; }
    ReturnType onError() override { return OPROS_SUCCESS; }
    ReturnType onRecover() override { return OPROS_SUCCESS; }
    ReturnType onDestroy() override { return OPROS_SUCCESS; }

  private:
    /// One word per line; an empty line ends it.
    void read_words() {
        std::string word;
        for (char letter = 0; read(pipe_, &letter, 1) == 1;) {
            if (letter != '\n') {
                word += letter;
                continue;
            }
            if (word.empty()) return;
            ask(word);
            word.clear();
        }
    }
    void ask(const std::string& word) {
        try {
            print("pages: " + std::to_string(dictionary_->pages(word, {2.5}).back()) + " of " + word);
        } catch (MethodInvokeException& error) {
            print("refused: " + error.getMessage() + " for " + word);
        }
    }
    /// In one piece, since two threads print.
    static void print(const std::string& line) { std::osyncstream(std::cout) << line + "\n" << std::flush; }

    int pipe_ = -1;
    std::thread reader_;
    InputDataPort<std::string> reply_;
    DictionaryRequired* dictionary_ = new DictionaryRequired; // the component deletes its service ports
};

extern "C" {
Component* getComponent() { return new WaitComp; }
void releaseComponent(Component* component) { delete component; }
}
