// SPDX-License-Identifier: Apache-2.0
// Every result of every check, on file trees and answers of system calls made for it.
#include "apps/tandem/doctor/checks.hpp"

#include <catch2/catch.hpp>

#include <cerrno>
#include <fstream>
#include <set>
#include <unistd.h>

using namespace tandem::doctor;

namespace {

/// A machine of files in a temporary folder, on which all checks are ok until a test changes it.
class FakeMachine {
  public:
    FakeMachine() {
        std::string name = (std::filesystem::temp_directory_path() / "tandem-doctor-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        machine.root = name;
        machine.probed = {.memlock_limit = unlimited,
                          .rtprio_limit = 90,
                          .files_limit = 1024,
                          .shm_bytes = gib,
                          .shm_free = gib,
                          .timer_slack_ns = 50'000,
                          .cores = 4,
                          .user = 1000,
                          .clock_synchronized = true,
                          .clock_max_error_us = 250};
        mount("tmpfs", "rw,nosuid,nodev,huge=within_size");
        file("/sys/kernel/mm/transparent_hugepage/shmem_enabled",
             "always within_size advise [never] deny force\n");
        file("/run/systemd/system/.keep", "");
        file("/etc/systemd/logind.conf", "[Login]\nRemoveIPC=no\n");
        file("/proc/sys/kernel/sched_rt_runtime_us", "-1\n");
        file("/proc/sys/kernel/sched_rt_period_us", "1000000\n");
        file("/proc/sys/fs/inotify/max_user_instances", "128\n");
        file("/proc/sys/fs/inotify/max_user_watches", "65536\n");
        file("/sys/devices/system/cpu/isolated", "2-3\n");
        file("/sys/devices/system/cpu/nohz_full", "2-3\n");
        file("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance\n");
        file("/sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance\n");
        file("/proc/sys/kernel/version", "#1 SMP PREEMPT_RT Debian 6.1\n");
        file("/sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc\n");
        file("/proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu tsc sse2\nbugs\t: x\n");
    }
    ~FakeMachine() { std::filesystem::remove_all(machine.root); }
    FakeMachine(const FakeMachine&) = delete;
    FakeMachine& operator=(const FakeMachine&) = delete;

    void file(const std::string& name, const std::string& content) {
        const auto path = machine.path(name);
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << content;
    }
    void mount(const std::string& type, const std::string& options) {
        file("/proc/self/mounts", "proc /proc proc rw 0 0\ntmpfs /dev/shm ext4 rw 0 0\n" + type +
                                      " /dev/shm " + type + " " + options + " 0 0\n");
    }
    void no_file(const std::string& name) { std::filesystem::remove(machine.path(name)); }

    static constexpr std::uint64_t gib = std::uint64_t{1} << 30;
    Machine machine;
};

/// Checks a result: its status, a part of its value, and that it has advice, in one line, exactly if it is not ok.
bool is(const CheckResult& result, CheckStatus status, const std::string& value) {
    INFO(result.name << ": " << result.value << " - " << result.advice);
    CHECK(result.status == status);
    CHECK(result.value.find(value) != std::string::npos);
    CHECK(result.advice.empty() == (status == CheckStatus::ok));
    CHECK(result.advice.find('\n') == std::string::npos);
    return result.status == status;
}

} // namespace

TEST_CASE_METHOD(FakeMachine, "every check is ok on a machine that is set up for Tandem") {
    const auto results = run_checks(machine);
    CHECK(results.size() == 21);
    std::set<std::string> names;
    for (const auto& result : results) {
        INFO(result.name << ": " << result.value);
        CHECK(result.status == CheckStatus::ok);
        CHECK_FALSE(result.value.empty());
        names.insert(result.name);
    }
    CHECK(names.size() == results.size());
}

TEST_CASE_METHOD(FakeMachine, "every check has a result on a machine without any of the files") {
    std::filesystem::remove_all(machine.root);
    CHECK(run_checks(machine).size() == 21);
}

TEST_CASE_METHOD(FakeMachine, "/dev/shm must be a writable tmpfs") {
    is(check_shm_mount(machine), CheckStatus::ok, "tmpfs");
    mount("ext4", "rw");
    is(check_shm_mount(machine), CheckStatus::error, "ext4");
    mount("tmpfs", "ro,relatime");
    is(check_shm_mount(machine), CheckStatus::error, "read-only");
    no_file("/proc/self/mounts");
    is(check_shm_mount(machine), CheckStatus::error, "nothing is mounted");
}

TEST_CASE_METHOD(FakeMachine, "/dev/shm must have room for a link and should have room for images") {
    is(check_shm_space(machine), CheckStatus::ok, "1 GiB free");
    machine.probed.shm_free = std::uint64_t{64} << 20;
    is(check_shm_space(machine), CheckStatus::warning, "64 MiB free of 1 GiB");
    machine.probed.shm_free = std::uint64_t{1} << 20;
    is(check_shm_space(machine), CheckStatus::error, "1 MiB free");
}

TEST_CASE_METHOD(FakeMachine, "huge pages depend on the mount, unless the kernel forces or denies them") {
    const auto shmem = "/sys/kernel/mm/transparent_hugepage/shmem_enabled";
    is(check_huge_pages(machine), CheckStatus::ok, "huge=within_size");
    mount("tmpfs", "rw");
    is(check_huge_pages(machine), CheckStatus::warning, "huge=never");
    mount("tmpfs", "rw,huge=advise");
    is(check_huge_pages(machine), CheckStatus::warning, "huge=advise");
    file(shmem, "always within_size advise never deny [force]\n");
    is(check_huge_pages(machine), CheckStatus::ok, "forced");
    mount("tmpfs", "rw,huge=always");
    file(shmem, "always within_size advise never [deny] force\n");
    is(check_huge_pages(machine), CheckStatus::warning, "denied");
    no_file(shmem);
    is(check_huge_pages(machine), CheckStatus::warning, "not in this kernel");
}

TEST_CASE_METHOD(FakeMachine, "RemoveIPC is read by logind's rules") {
    is(check_remove_ipc(machine), CheckStatus::ok, "no (/etc/systemd/logind.conf)");
    SECTION("a comment sets nothing and the default is yes") {
        file("/etc/systemd/logind.conf", "[Login]\n#RemoveIPC=no\n");
        is(check_remove_ipc(machine), CheckStatus::warning, "yes (the default)");
    }
    SECTION("only the section Login counts") {
        file("/etc/systemd/logind.conf", "[Other]\nRemoveIPC=no\n");
        is(check_remove_ipc(machine), CheckStatus::warning, "yes");
    }
    SECTION("a drop-in file overrides the main file") {
        file("/etc/systemd/logind.conf.d/50-ipc.conf", "[Login]\nRemoveIPC = yes\n");
        is(check_remove_ipc(machine), CheckStatus::warning, "50-ipc.conf");
    }
    SECTION("the drop-in with the last name wins, in whatever folder") {
        file("/etc/systemd/logind.conf.d/10-a.conf", "[Login]\nRemoveIPC=yes\n");
        file("/usr/lib/systemd/logind.conf.d/90-b.conf", "[Login]\nRemoveIPC=off\n");
        is(check_remove_ipc(machine), CheckStatus::ok, "off");
    }
    SECTION("a file hides files with the same name in later folders") {
        file("/etc/systemd/logind.conf.d/50-ipc.conf", "");
        file("/usr/lib/systemd/logind.conf.d/50-ipc.conf", "[Login]\nRemoveIPC=yes\n");
        is(check_remove_ipc(machine), CheckStatus::ok, "no");
    }
    SECTION("system users are exempt") {
        file("/etc/systemd/logind.conf", "[Login]\nRemoveIPC=yes\n");
        is(check_remove_ipc(machine), CheckStatus::warning, "yes");
        machine.probed.user = 120;
        is(check_remove_ipc(machine), CheckStatus::ok, "system user");
    }
    SECTION("the setting does not matter if systemd is not running") {
        file("/etc/systemd/logind.conf", "[Login]\nRemoveIPC=yes\n");
        std::filesystem::remove_all(machine.path("/run/systemd"));
        is(check_remove_ipc(machine), CheckStatus::ok, "is not running");
    }
}

TEST_CASE_METHOD(FakeMachine, "a missing permission is a warning with its reason") {
    is(check_memory_locking(machine), CheckStatus::ok, "permitted");
    is(check_sched_fifo(machine), CheckStatus::ok, "permitted");
    machine.probed.lock_error = ENOMEM;
    machine.probed.fifo_error = EPERM;
    is(check_memory_locking(machine), CheckStatus::warning, "refused (Cannot allocate memory)");
    is(check_sched_fifo(machine), CheckStatus::warning, "refused (Operation not permitted)");
}

TEST_CASE_METHOD(FakeMachine, "a low limit is a warning only for users to whom it applies") {
    is(check_memlock_limit(machine), CheckStatus::ok, "unlimited");
    is(check_rtprio_limit(machine), CheckStatus::ok, "90");
    machine.probed.memlock_limit = 8 << 20;
    machine.probed.rtprio_limit = 0;
    is(check_memlock_limit(machine), CheckStatus::ok, "8 MiB, does not limit");
    is(check_rtprio_limit(machine), CheckStatus::ok, "0, does not limit");
    machine.probed.lock_error = machine.probed.fifo_error = EPERM;
    is(check_memlock_limit(machine), CheckStatus::warning, "8 MiB");
    is(check_rtprio_limit(machine), CheckStatus::warning, "0");
}

TEST_CASE_METHOD(FakeMachine, "if the packages are installed, the advice is to join their group") {
    machine.probed.memlock_limit = 8 << 20;
    machine.probed.rtprio_limit = 0;
    machine.probed.lock_error = machine.probed.fifo_error = machine.probed.dma_latency_error = EPERM;
    const auto says = [](const CheckResult& result, const char* text) {
        INFO(result.advice);
        return result.advice.find(text) != std::string::npos;
    };
    for (const auto check : {check_memlock_limit, check_memory_locking, check_rtprio_limit, check_sched_fifo,
                             check_dma_latency}) {
        no_file("/etc/security/limits.d/tandem.conf");
        CHECK(says(check(machine), "realtime"));
        file("/etc/security/limits.d/tandem.conf", "@tandem - rtprio 90\n");
        CHECK(says(check(machine), "adduser USER tandem"));
        CHECK_FALSE(says(check(machine), "realtime"));
    }
}

TEST_CASE_METHOD(FakeMachine, "real-time throttling is a warning") {
    is(check_realtime_throttling(machine), CheckStatus::ok, "off");
    file("/proc/sys/kernel/sched_rt_runtime_us", "950000\n");
    is(check_realtime_throttling(machine), CheckStatus::warning, "950000 of each 1000000 us");
    no_file("/proc/sys/kernel/sched_rt_runtime_us");
    is(check_realtime_throttling(machine), CheckStatus::ok, "not in this kernel");
}

TEST_CASE_METHOD(FakeMachine, "a low limit of open files is a warning or an error") {
    is(check_open_files(machine), CheckStatus::ok, "1024");
    machine.probed.files_limit = 256;
    is(check_open_files(machine), CheckStatus::warning, "256");
    machine.probed.files_limit = 20;
    is(check_open_files(machine), CheckStatus::error, "20");
    machine.probed.files_limit = unlimited;
    is(check_open_files(machine), CheckStatus::ok, "unlimited");
}

TEST_CASE_METHOD(FakeMachine, "a link needs an inotify instance") {
    is(check_inotify(machine), CheckStatus::ok, "128 instances");
    file("/proc/sys/fs/inotify/max_user_instances", "8\n");
    is(check_inotify(machine), CheckStatus::warning, "8 instances");
    file("/proc/sys/fs/inotify/max_user_instances", "many\n");
    is(check_inotify(machine), CheckStatus::warning, "unknown");
    machine.probed.inotify_error = EMFILE;
    is(check_inotify(machine), CheckStatus::error, "Too many open files");
}

TEST_CASE_METHOD(FakeMachine, "two hosts need two cores, preferably isolated ones") {
    is(check_core_count(machine), CheckStatus::ok, "4");
    machine.probed.cores = 1;
    is(check_core_count(machine), CheckStatus::warning, "1");
    is(check_isolated_cores(machine), CheckStatus::ok, "2-3");
    is(check_nohz_full(machine), CheckStatus::ok, "2-3");
    file("/sys/devices/system/cpu/isolated", "\n");
    file("/sys/devices/system/cpu/nohz_full", "  (null)\n");
    is(check_isolated_cores(machine), CheckStatus::warning, "none");
    is(check_nohz_full(machine), CheckStatus::warning, "none");
}

TEST_CASE_METHOD(FakeMachine, "one core with another governor is enough for a warning") {
    is(check_governor(machine), CheckStatus::ok, "performance");
    file("/sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "schedutil\n");
    is(check_governor(machine), CheckStatus::warning, "performance, schedutil");
    std::filesystem::remove_all(machine.path("/sys/devices/system/cpu"));
    is(check_governor(machine), CheckStatus::ok, "none");
}

TEST_CASE_METHOD(FakeMachine, "low-latency-idle needs its device") {
    is(check_dma_latency(machine), CheckStatus::ok, "writable");
    machine.probed.dma_latency_error = EACCES;
    is(check_dma_latency(machine), CheckStatus::warning, "not writable (Permission denied)");
    machine.probed.dma_latency_error = ENOENT;
    is(check_dma_latency(machine), CheckStatus::warning, "does not exist");
}

TEST_CASE_METHOD(FakeMachine, "the preemption mode is found in each place where a kernel shows it") {
    const auto version = [&](const std::string& text) { file("/proc/sys/kernel/version", text); };
    is(check_preemption(machine), CheckStatus::ok, "PREEMPT_RT");
    version("#1 SMP PREEMPT Debian\n");
    is(check_preemption(machine), CheckStatus::ok, "full");
    version("#1 SMP Debian\n");
    is(check_preemption(machine), CheckStatus::warning, "none or voluntary");
    version("#1 SMP PREEMPT_DYNAMIC Debian\n");
    is(check_preemption(machine), CheckStatus::warning, "not visible");
    file("/proc/cmdline", "quiet preempt=full root=/dev/sda\n");
    is(check_preemption(machine), CheckStatus::ok, "full");
    file("/sys/kernel/debug/sched/preempt", "none (voluntary) full\n");
    is(check_preemption(machine), CheckStatus::warning, "voluntary");
    file("/sys/kernel/realtime", "1\n");
    is(check_preemption(machine), CheckStatus::ok, "PREEMPT_RT");
}

TEST_CASE_METHOD(FakeMachine, "a clock source that needs a system call is a warning") {
    const auto source = "/sys/devices/system/clocksource/clocksource0/current_clocksource";
    is(check_clock_source(machine), CheckStatus::ok, "tsc");
    file(source, "hpet\n");
    is(check_clock_source(machine), CheckStatus::warning, "hpet");
    no_file(source);
    is(check_clock_source(machine), CheckStatus::warning, "unknown");
}

TEST_CASE_METHOD(FakeMachine,
                 "an unsynchronized clock is a warning, and the synchronizing program is named") {
    is(check_clock_synchronization(machine), CheckStatus::ok, "within 250 us");
    file("/proc/71/comm", "ptp4l\n");
    file("/proc/72/comm", "phc2sys\n");
    file("/proc/73/comm", "bash\n");
    const auto result = check_clock_synchronization(machine);
    is(result, CheckStatus::ok, "phc2sys");
    is(result, CheckStatus::ok, "ptp4l");
    machine.probed.clock_synchronized = false;
    no_file("/proc/71/comm");
    is(check_clock_synchronization(machine), CheckStatus::warning, "unsynchronized (phc2sys)");
}

TEST_CASE_METHOD(FakeMachine, "a large timer slack is a warning") {
    is(check_timer_slack(machine), CheckStatus::ok, "50 us");
    machine.probed.timer_slack_ns = 40'000'000;
    is(check_timer_slack(machine), CheckStatus::warning, "40 ms");
}

TEST_CASE_METHOD(FakeMachine, "a virtual machine is a warning that names its vendor") {
    is(check_hypervisor(machine), CheckStatus::ok, "none");
    file("/proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu hypervisor tsc\nbugs\t: x\n");
    is(check_hypervisor(machine), CheckStatus::warning, "yes");
    file("/sys/class/dmi/id/sys_vendor", "QEMU\n");
    file("/sys/class/dmi/id/product_name", "Standard PC\n");
    is(check_hypervisor(machine), CheckStatus::warning, "QEMU Standard PC");
}

TEST_CASE_METHOD(FakeMachine, "a processor that reports no hypervisor is not claimed to have none") {
    file("/proc/cpuinfo", "processor\t: 0\nBogoMIPS\t: 108.00\nFeatures\t: fp asimd evtstrm crc32 cpuid\n");
    is(check_hypervisor(machine), CheckStatus::ok, "unknown");
}

TEST_CASE("every check has a result on this machine") {
    const Machine machine = probe_this_machine();
    CHECK(machine.probed.cores >= 1);
    CHECK(machine.probed.shm_bytes > 0);
    CHECK(machine.probed.user == geteuid());
    CHECK(run_checks(machine).size() == 21);
}
