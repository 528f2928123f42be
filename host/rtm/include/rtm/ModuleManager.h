// SPDX-License-Identifier: Apache-2.0
// Names of the settings of rtc.conf for modules. Manager::load() loads modules.
#ifndef RTC_MODULEMANAGER_H
#define RTC_MODULEMANAGER_H
#include <coil/DynamicLib.h>
#include <coil/Properties.h>
#include <rtm/Manager.h>
#include <rtm/ObjectManager.h>

#define CONFIG_EXT "manager.modules.config_ext"
#define CONFIG_PATH "manager.modules.config_path"
#define DETECT_MOD "manager.modules.detect_loadable"
#define MOD_LOADPTH "manager.modules.load_path"
#define INITFUNC_SFX "manager.modules.init_func_suffix"
#define INITFUNC_PFX "manager.modules.init_func_prefix"
#define ALLOW_ABSPATH "manager.modules.abs_path_allowed"
#define ALLOW_URL "manager.modules.download_allowed"
#define MOD_DWNDIR "manager.modules.download_dir"
#define MOD_DELMOD "manager.modules.download_cleanup"
#define MOD_PRELOAD "manager.modules.preload"
#endif
