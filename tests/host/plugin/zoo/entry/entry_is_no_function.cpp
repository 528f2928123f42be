// SPDX-License-Identifier: Apache-2.0
#ifdef ZOO_INIT
extern "C" const int ZOO_INIT;
extern "C" const int ZOO_INIT = 7;
#else
extern "C" const int getComponent;
extern "C" const int getComponent = 7;
#endif
