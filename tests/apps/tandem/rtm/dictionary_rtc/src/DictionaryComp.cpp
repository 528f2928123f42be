// SPDX-License-Identifier: Apache-2.0
#include <rtm/Manager.h>

#include "Dictionary.h"

void MyModuleInit(RTC::Manager* manager) {
    DictionaryInit(manager);
    RTC::RtcBase* comp = manager->createComponent("Dictionary");
    if (comp == NULL) {
        std::cerr << "Component create failed." << std::endl;
        abort();
    }
}

int main(int argc, char** argv) {
    RTC::Manager* manager = RTC::Manager::init(argc, argv);
    manager->init(argc, argv);
    manager->setModuleInitProc(MyModuleInit);
    manager->activateManager();
    manager->runManager();
    return 0;
}
